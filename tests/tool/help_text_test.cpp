// SPDX-License-Identifier: BSD-3-Clause
// Tests the texts that are made from a command line: help, errors, manual page, completion; and words with numbers.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge_tools/choice_option.hpp"
#include "hinge_tools/completion.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/help_formatter.hpp"
#include "hinge_tools/man_page.hpp"
#include "hinge_tools/max_pairs_option.hpp"
#include "hinge_tools/nearest_word.hpp"
#include "hinge_tools/parse_command_line.hpp"
#include "hinge_tools/wrap_text.hpp"

namespace hinge::tool {
namespace help_text_test {

TEST(Counted, IsSingularForOne) {
  EXPECT_EQ(counted(0, "pair"), "0 pairs");
  EXPECT_EQ(counted(1, "pair"), "1 pair");
  EXPECT_EQ(counted(2, "pair of links", "pairs of links"), "2 pairs of links");
  EXPECT_EQ(collide_text(0, 1, "model"), "0 of 1 model collides");
  EXPECT_EQ(collide_text(1, 3, "model"), "1 of 3 models collides");
  EXPECT_EQ(collide_text(2, 3, "model"), "2 of 3 models collide");
}

TEST(NearestWord, IsCloseOrEmpty) {
  const std::vector<std::string> commands{"info", "check", "sample", "walk"};
  EXPECT_EQ(nearest_word("chekc", commands), "check");
  EXPECT_EQ(nearest_word("smaple", commands), "sample");
  EXPECT_EQ(nearest_word("inf", commands), "info");
  EXPECT_EQ(nearest_word("molecule", commands), "");
  EXPECT_EQ(nearest_word("", commands), "");
  EXPECT_EQ(edit_distance("ab", "ba"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
}

TEST(WrapText, KeepsToTheWidth) {
  EXPECT_EQ(wrap_text("one two three", 0, 2, 8), "one two\n  three");
  EXPECT_EQ(wrap_text("one two", 5, 5, 8), "one\n     two");
  EXPECT_EQ(wrap_text("a-word-too-long b", 0, 1, 4), "a-word-too-long\n b");
  EXPECT_EQ(wrap_text("", 0, 0, 8), "");
}

TEST(MaxPairs, LimitsTablesOnlyUnlessGiven) {
  EXPECT_EQ(pairs_to_print(std::nullopt, true, 100), usual_max_pairs);
  EXPECT_EQ(pairs_to_print(std::nullopt, true, 3), 3U);
  EXPECT_EQ(pairs_to_print(std::nullopt, false, 100), 100U);
  for (const bool is_table : {true, false}) {
    EXPECT_EQ(pairs_to_print(5, is_table, 100), 5U);
    EXPECT_EQ(pairs_to_print(0, is_table, 100), 100U);
  }
  EXPECT_EQ(left_out_text(0), "");
  EXPECT_EQ(left_out_text(31), "  ... and 31 more; --max-pairs all lists them\n");
}

/// A tool with one command, `run FILE [--mode fast|slow] [--count N] [--out FILE] [--old]`.
struct Tool {
  HelpTexts texts;
  CLI::App app{"answers questions", "tool"};
  std::string file, mode = "fast", out;
  std::uint64_t count = 10;
  std::optional<std::uint64_t> max_pairs;

  Tool() {
    texts.description = "tool answers questions. Its 'words' are -short-.";
    texts.topics = {{"Words", {"Words are words.", "  .table  'of' words", "  -more   words"}}};
    texts.commands["run"] = {{"Words"}, {"tool run a.txt", "tool run 'b c.txt' --mode slow"}};
    add_general_options(app, texts, "tool 1");
    CLI::App* run = app.add_subcommand("run", "run a file");
    run->option_defaults()->group(title::output);
    run->add_option("--out", out, "write here")->type_name("FILE");
    run->option_defaults()->group(title::input);
    run->add_option("FILE", file, "what to run")->required();
    run->option_defaults()->group(title::question);
    add_choice(
        *run, "--mode", {"fast", "slow"}, [this](const std::string& word) { mode = word; },
        "how to run (default: fast)");
    constexpr NumberRange<std::uint64_t> range{1, 100};
    add_number(*run, "-n,--count", count, range,
               "how often, with a description of so many words that it takes two lines")
        ->needs("--out");
    run->add_option("--seed", mode, "start of (seed, k)")->capture_default_str();
    add_max_pairs(*run, max_pairs);
    app.add_subcommand("list", "list files");
  }

  /// Returns the message of the error that the arguments give; "none" without an error.
  std::string refusal(const std::vector<std::string>& arguments) {
    try {
      parse_command_line(app, arguments, texts);
      return "none";
    } catch (const ModelError& error) {
      return error.what();
    }
  }
};

TEST(Help, HasTitlesPlaceholdersDefaultsAndExamples) {
  Tool tool;
  EXPECT_EQ(tool.app.get_subcommand("run")->help("tool"),
            "tool run: run a file\n\n"
            "Usage: tool run FILE [options]\n\n"
            "Input:\n"
            "  FILE                        what to run\n\n"
            "Question:\n"
            "  --mode fast|slow            how to run (default: fast)\n"
            "  -n, --count N               how often, with a description of so many words that it takes two lines\n"
            "                              (default: 10; needs --out)\n"
            "  --seed TEXT                 start of (seed, k) (default: fast)\n"
            "  --max-pairs N|all           largest number of pairs to print for each conformation; 0 or all: no\n"
            "                              limit (default: 20 in tables, all with --json and --csv)\n\n"
            "Output:\n"
            "  --out FILE                  write here\n\n"
            "General:\n"
            "  -h, --help                  print this help\n\n"
            "Words:\n"
            "  Words are words.\n"
            "  .table  'of' words\n"
            "  -more   words\n\n"
            "Examples:\n"
            "  tool run a.txt\n"
            "  tool run 'b c.txt' --mode slow\n");
}

TEST(Errors, NameWhatIsWrongAndTheNearestName) {
  const auto refusal = [](const std::vector<std::string>& arguments) { return Tool().refusal(arguments); };
  EXPECT_EQ(refusal({"rnu", "a"}), "unknown command 'rnu'; did you mean 'run'? See 'tool --help'");
  EXPECT_EQ(refusal({"xyz"}), "unknown command 'xyz'; expected run, list. See 'tool --help'");
  EXPECT_EQ(refusal({"run", "a", "--mdoe", "fast"}),
            "unknown option '--mdoe' of 'tool run'; did you mean '--mode'? See 'tool run --help'");
  EXPECT_EQ(refusal({"run", "--xyz=1"}), "unknown option '--xyz' of 'tool run'. See 'tool run --help'");
  EXPECT_EQ(refusal({"--out", "run", "a"}), "option '--out' is in front of the command, expected it after 'tool run'");
  EXPECT_EQ(refusal({"--nothing"}), "unknown option '--nothing' of 'tool'. See 'tool --help'");
  EXPECT_EQ(refusal({"run", "a", "b"}), "unexpected argument 'b'; see 'tool run --help'");
  EXPECT_EQ(refusal({"run", "a", "-x"}), "unknown option '-x' of 'tool run'. See 'tool run --help'");
  EXPECT_EQ(refusal({"run", "a", "--out"}), "--out: expected FILE after it; see 'tool run --help'");
  EXPECT_EQ(refusal({"run"}), "FILE is required; see 'tool run --help'");
  EXPECT_EQ(refusal({"run", "a", "--mode", "fats"}), "--mode 'fats': expected fast or slow; did you mean 'fast'?");
  EXPECT_EQ(refusal({"run", "a", "--max-pairs", "some"}),
            "--max-pairs 'some': expected a whole number from 0 to 9007199254740992");
  EXPECT_EQ(refusal({"--completion", "csh"}), "--completion 'csh': expected bash, zsh or fish");
  EXPECT_EQ(refusal({"run", "a", "--mode", "slow"}), "none");
}

TEST(Errors, NoArgumentsPrintTheUsage) {
  Tool tool;
  EXPECT_EQ(parse_command_line(tool.app, {}, tool.texts), Exit::usage);
}

TEST(Options, AreRead) {
  Tool tool;
  EXPECT_EQ(parse_command_line(tool.app, {"run", "a", "--mode", "slow", "--max-pairs", "all"}, tool.texts),
            std::nullopt);
  EXPECT_EQ(tool.mode, "slow");
  EXPECT_EQ(tool.max_pairs, 0U);
}

TEST(ManPage, QuotesWhatRoffWouldRead) {
  const Tool tool;
  const std::string page = man_page(tool.app, tool.texts);
  for (const char* part : {".TH TOOL 1", "tool \\- answers questions\n", "Its \\(aqwords\\(aq are \\-short\\-.\n",
                           ".SS run\nRun a file.\n", "\\fB\\-\\-mode fast|slow\\fR\n",
                           ".SH WORDS\nWords are words.\n.PP\n.EX\n  .table  \\(aqof\\(aq words\n",
                           "Shared options: \\-\\-help.\n", ".EX\ntool run a.txt\n"})
    EXPECT_NE(page.find(part), std::string::npos) << part << "\nin\n" << page;
  EXPECT_EQ(roff_text(".x"), "\\&.x");
  EXPECT_EQ(roff_text("a\\b"), "a\\eb");
}

TEST(Completion, KnowsChoicesAndFiles) {
  const Tool tool;
  const std::string bash = completion_script(tool.app, "bash");
  for (const char* part : {"--mode) kind=words words='fast slow'", "--max-pairs) kind=words words='all'",
                           "--out) kind=files", "-n|--count|--seed) kind=value", "complete -F _tool tool"})
    EXPECT_NE(bash.find(part), std::string::npos) << part << "\nin\n" << bash;
  EXPECT_NE(completion_script(tool.app, "zsh").find("'*--mode[how to run (default: fast)]:value:(fast slow)'"),
            std::string::npos);
  EXPECT_NE(completion_script(tool.app, "fish").find("-l mode -x -a 'fast slow' -d 'how to run (default: fast)'\n"),
            std::string::npos);
  EXPECT_EQ(completion_script(tool.app, "csh"), "");
}

}  // namespace help_text_test
}  // namespace hinge::tool
