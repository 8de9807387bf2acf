// SPDX-License-Identifier: BSD-3-Clause
// Writes the texts of the help.
#include "help.hpp"

#include "hinge/version.hpp"
#include "hinge_tools/exit_zero_option.hpp"

namespace robocd {

using hinge::tool::HelpTexts;

HelpTexts help_texts() {
  const std::string arm = " robotics/data/arm.urdf", srdf = " --srdf robotics/data/arm.srdf";
  HelpTexts texts;
  texts.version = hinge::version_string;
  texts.description =
      "robocd tests the links of a robot for collisions with each other and with bodies around the robot. It reads "
      "URDF "
      "files with their meshes, and SRDF files. Results go to standard output, notes to standard error.";
  texts.topics = {
      {"Units", {"Lengths are metres, angles radians."}},
      {"Pairs",
       {"All pairs of links are tested, except pairs in one rigid group, pairs joined by one movable joint, "
        "and pairs disabled by --srdf or --skip-pairs."}},
      hinge::tool::exit_status_topic()};
  texts.commands[""] = {{"Exit status"}, {"robocd check" + arm + " --zero", "robocd path --help"}};
  texts.commands["info"] = {{"Units", "Pairs"}, {"robocd info" + arm, "robocd info" + arm + srdf + " --json"}};
  texts.commands["check"] = {{"Units", "Pairs", "Exit status"},
                             {"robocd check" + arm + srdf + " --random 1000 --seed 1",
                              "robocd check" + arm + srdf + " --state arm/reach --mode closest"}};
  texts.commands["merge"] = {
      {"Exit status"},
      {"robocd check" + arm + " --random 1000 --csv --parts run --unit 500", "robocd merge run --out run.csv"}};
  texts.commands["path"] = {{"Units", "Pairs", "Exit status"},
                            {"robocd path" + arm + srdf + " --from zero --to state:arm/reach",
                             "robocd path" + arm + " --from zero --to 0,0.5,0,0,0,0 --env robotics/data/shelf.obj"}};
  texts.commands["relax"] = {{"Units", "Pairs", "Exit status"},
                             {"robocd relax" + arm + srdf + " --from 0,2.8,2.6,0,0,0",
                              "robocd relax" + arm + " --from 0,0.6,1.2,0,0.4,0 --env robotics/data/shelf.obj"}};
  texts.commands["plan"] = {{"Units", "Pairs", "Exit status"},
                            {"robocd plan" + arm + " --from zero --to 0,0.5,0,0,0,0",
                             "robocd plan" + arm + " --from zero --to 1,0,0,0,0,0 --step 0.1 --out m.csv"}};
  texts.commands["dial"] = {{"Units", "Pairs"},
                            {"robocd dial" + arm + " --time 2 --apply arm.settings",
                             "robocd dial" + arm + " --time 2 --extremes --report dial.html"}};
  texts.commands["matrix"] = {{"Units", "Pairs"},
                              {"robocd matrix" + arm + " --samples 1000",
                               "robocd matrix" + arm + " --samples 1000 --disable-unseen --out matrix.srdf"}};
  const std::string motion = " --from zero --to 1,0,0,0,0,0 --out robot.svg";
  texts.commands["demo"] = {{}, {"robocd demo" + arm + motion, "robocd demo" + arm + " --tier capsule" + motion}};
  return texts;
}

}  // namespace robocd
