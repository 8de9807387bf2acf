// SPDX-License-Identifier: BSD-3-Clause
// Writes the texts of the help.
#include "help.hpp"

#include <string>
#include <vector>

#include "hinge/version.hpp"
#include "hinge_tools/exit_zero_option.hpp"

namespace biocd {

using hinge::tool::HelpTexts;
using hinge::tool::Topic;

namespace {

Topic selections() {
  const std::string omega =
      "omega stays at its reference unless --omega is given or a word names it. Parts (--place, --between, --inside) "
      "and "
      "loops are residues, so their selections name no torsions.";
  return {"Selections",
          {"A selection (--free, --loop, --place, --between, --inside) joins words:",
           "  all  none  loops  ligands     everything; nothing; outside HELIX and SHEET; outside polymers",
           "  A  KNI  file:2                a chain; residues of a name; the second file",
           "  A:45  A:10-20  A:HEM          residues of a chain, by number or name",
           "  every:5  count:10             every fifth residue; ten residues at equal distances",
           "  backbone  chi  phi  chi1      torsions of a kind, in every residue",
           "  A:45:chi1  A:10-20:phi,psi    torsions of these residues",
           "  B:401:C5-C6                   the torsion about a bond of a ligand",
           "  ,  or  and  not  ( )          operators: 'A and not (A:10-20 or omega)'; a comma means or", omega}};
}

}  // namespace

HelpTexts help_texts() {
  const std::vector<std::string> both{"Selections", "Exit status"};
  const std::string file = " molecular/data/1ubq.pdb";
  HelpTexts texts;
  texts.version = hinge::version_string;
  texts.description =
      "biocd tests proteins, nucleic acids and ligands for collisions with themselves and with each other. A molecule "
      "is a mechanism: torsions turn about single bonds, and bond lengths and angles stay. Results go to standard "
      "output, notes to standard error.";
  texts.topics = {selections(), hinge::tool::exit_status_topic()};
  texts.commands[""] = {{"Exit status"}, {"biocd check" + file, "biocd sample --help"}};
  texts.commands["info"] = {{"Selections"}, {"biocd info" + file, "biocd info" + file + " --free A:70-76 --json"}};
  texts.commands["check"] = {both, {"biocd check" + file, "biocd check" + file + " --mode within:0.3 --by residue"}};
  texts.commands["sample"] = {both,
                              {"biocd sample" + file + " --free A:70-76 --sigma 5 --exempt-reference",
                               "biocd sample" + file + " --loop A:7-11 --collision-free -n 50 --out loops.pdb"}};
  texts.commands["walk"] = {both,
                            {"biocd walk" + file + " --exempt-reference --steps 2000 --out walk.pdb",
                             "biocd walk" + file + " --exempt-reference --free A:70-76 --step-size 10 --steps 500"}};
  texts.commands["relax"] = {
      both, {"biocd relax" + file + " --out relaxed.pdb", "biocd relax" + file + " --free chi --json"}};
  texts.commands["path"] = {both,
                            {"biocd path" + file + " --free A:72:psi --exempt-reference --from reference --to 20",
                             "biocd path" + file + " --free A:72:phi,psi --from 0,0 --to 30,-40 --sampled 0.5"}};
  texts.commands["plan"] = {both,
                            {"biocd plan" + file + " --free A:74-76:psi --exempt-reference --to -120,-120,90",
                             "biocd plan" + file + " --free A:74-76:psi --exempt-reference --to 90,90,90 --out m.pdb"}};
  texts.commands["dial"] = {{"Selections"},
                            {"biocd dial" + file + " --exempt-reference --time 2 --apply 1ubq.settings",
                             "biocd dial" + file + " --free A:70-76 --time 2 --extremes --report dial.html"}};
  texts.commands["merge"] = {
      {"Exit status"}, {"biocd sample" + file + " -n 10 --csv --parts run --unit 5", "biocd merge run --out run.csv"}};
  texts.commands["demo"] = {
      {}, {"biocd demo" + file + " --out demo -n 100", "biocd demo" + file + " --out demo -n 100 --seed 2"}};
  return texts;
}

}  // namespace biocd
