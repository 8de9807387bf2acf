// SPDX-License-Identifier: BSD-3-Clause
// Tests output files: unique temporary files, links, devices, pipes, signals, and protected files.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge_tools/check_output.hpp"
#include "hinge_tools/complete_file.hpp"
#include "hinge_tools/run_tool.hpp"

namespace hinge::tool {
namespace output_files_test {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A test with a temporary folder, removed afterwards.
class OutputFiles : public testing::Test {
 protected:
  OutputFiles() { fs::create_directories(folder); }
  ~OutputFiles() override { fs::remove_all(folder); }
  /// Returns the sorted names in the folder.
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path().filename());
    std::sort(all.begin(), all.end());
    return all;
  }

  const fs::path folder = fs::temp_directory_path() / ("hinge-output-" + std::to_string(getpid()));
  const fs::path out = folder / "x.pdb";
};

std::string refusal(const std::string& path, const std::vector<fs::path>& inputs) {
  try {
    check_output("--out", path, inputs);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

TEST_F(OutputFiles, TwoWritersEachWriteTheirOwn) {
  std::ofstream(folder / "x.pdb.partial") << "a user's own";
  {
    CompleteFile first(out.string()), second(out.string());
    EXPECT_EQ(names().size(), 3U);
    first.stream() << std::string(100000, '1') << std::flush;
    second.stream() << "2" << std::flush;
    second.finish();
    EXPECT_EQ(content(out), "2");
    first.finish();
    EXPECT_EQ(content(out), std::string(100000, '1'));
  }
  EXPECT_EQ(names(), (std::vector<std::string>{"x.pdb", "x.pdb.partial"}));
  EXPECT_EQ(content(folder / "x.pdb.partial"), "a user's own");
}

TEST_F(OutputFiles, HavePermissionsOfTheUmaskOrOfWhatTheyReplace) {
  const mode_t before = umask(027);
  const auto write = [&] {
    CompleteFile file(out.string());
    file.finish();
    struct stat status {};
    stat(out.c_str(), &status);
    return status.st_mode & 0777U;
  };
  EXPECT_EQ(write(), 0640U);
  chmod(out.c_str(), 0604);
  EXPECT_EQ(write(), 0604U);
  umask(before);
}

TEST_F(OutputFiles, FollowLinks) {
  fs::create_directory(folder / "data");
  fs::create_symlink("data/target.pdb", folder / "link");
  fs::create_symlink(folder / "link", out);
  for (const char* text : {"new", "newer"}) {
    CompleteFile file(out.string());
    file.stream() << text;
    file.finish();
    EXPECT_TRUE(fs::is_symlink(out) && fs::is_symlink(folder / "link"));
    EXPECT_EQ(content(folder / "data/target.pdb"), text);
  }
  EXPECT_EQ(names(), (std::vector<std::string>{"data", "link", "x.pdb"}));
  fs::create_symlink("circle", folder / "circle");
  EXPECT_THROW(CompleteFile((folder / "circle").string()), LoadError);
}

TEST_F(OutputFiles, KeepDevicesAndPipes) {
  CompleteFile device("/dev/null");
  EXPECT_FALSE(device.is_regular());
  device.stream() << "text";
  device.finish();
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  mkfifo(out.c_str(), 0600);
  std::string read;
  std::thread reader([&] { read = content(out); });
  CompleteFile pipe(out.string());
  pipe.stream() << "text";
  pipe.finish();
  reader.join();
  EXPECT_EQ(read, "text");
  EXPECT_TRUE(fs::is_fifo(out));
}

TEST_F(OutputFiles, NoticeAFullDiskAtOnce) {
  CompleteFile file("/dev/full");
  file.check();
  file.stream() << std::string(100000, 'x');
  try {
    file.check();
    FAIL() << "100000 bytes fit a full disk";
  } catch (const LoadError& error) {
    EXPECT_STREQ(error.what(), "/dev/full: cannot be written: No space left on device");
  }
}

TEST_F(OutputFiles, AreNoInputsFoldersOrStandardStreams) {
  std::ofstream(out) << "input";
  fs::create_symlink(out, folder / "link");
  fs::create_hard_link(out, folder / "hard");
  const std::vector<fs::path> inputs{folder / "absent", "", out};
  const std::string no_input = ": is the input " + out.string() + ", expected a different file to write";
  for (const char* name : {"x.pdb", "link", "hard", "./x.pdb"}) {
    const std::string path = (folder / name).string();
    EXPECT_EQ(refusal(path, inputs), "--out " + path + no_input);
  }
  EXPECT_EQ(refusal(folder.string(), {}), "--out " + folder.string() + ": is a directory, expected a file to write");
  EXPECT_EQ(refusal((folder / "new").string(), inputs), "");
  EXPECT_EQ(refusal("/dev/null", {"/dev/null"}), "");
  EXPECT_EQ(refusal("", {""}), "");
  EXPECT_THROW(CompleteFile(folder.string()), LoadError);
}

TEST_F(OutputFiles, LeaveNoTemporaryWhenASignalEndsTheProgram) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGPIPE}) {
    const pid_t child = fork();
    if (child == 0) {
      std::signal(signal, SIG_DFL);
      CompleteFile file(out.string());
      file.stream() << "half" << std::flush;
      raise(signal);
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
    EXPECT_EQ(names(), std::vector<std::string>{});
  }
}

TEST_F(OutputFiles, AreWrittenToTheEndUnderNohup) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGHUP, SIG_IGN);
    CompleteFile file(out.string());
    file.stream() << "whole";
    raise(SIGHUP);
    file.finish();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(content(out), "whole");
}

/// Returns the exit status of a child process that has this descriptor closed; its standard error is written to `said`.
template <class Run>
int with_closed(int descriptor, const fs::path& said, const Run& run) {
  const pid_t child = fork();
  if (child == 0) {
    if (descriptor != STDERR_FILENO && std::freopen(said.c_str(), "w", stderr) == nullptr) _exit(99);
    close(descriptor);
    const int status = run_tool("x", run);
    std::fflush(nullptr);
    _exit(status);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(OutputFiles, NeverGetWhatIsMeantForAStandardStream) {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const int status = with_closed(descriptor, folder / "said", [&] {
      CompleteFile file(out.string());
      file.stream() << "mine" << std::flush;
      const bool printed = std::fputs("printed", stdout) >= 0;
      std::fputs("a note", stderr);
      file.finish();
      return printed ? Exit::free : Exit::collision;
    });
    EXPECT_EQ(content(out), "mine") << descriptor;
    EXPECT_EQ(status, descriptor == STDOUT_FILENO ? 3 : 0) << descriptor;
    if (descriptor != STDOUT_FILENO) continue;
    EXPECT_NE(content(folder / "said").find("x: standard output: cannot be written: "), std::string::npos);
  }
}

TEST(RunTool, RefusesInOneLine) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_tool("x", []() -> Exit { throw LoadError("a\nb\x1b c\x7f"); }), 3);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "x: a\\nb\\x1b c\\x7f\n");
}

}  // namespace output_files_test
}  // namespace hinge::tool
