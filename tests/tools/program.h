// Starts the program as a user would, in a process of its own.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

// Process id of `fluidtex ARGS...`; what it prints on either stream goes to `output`.
inline pid_t startProgram(const std::vector<std::string>& args, const std::filesystem::path& output) {
  const pid_t child = fork();
  if (child != 0) return child;
  const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  dup2(file, STDOUT_FILENO);
  dup2(file, STDERR_FILENO);
  std::vector<char*> argv{const_cast<char*>(FLUIDTEX_PROGRAM)};
  for (const std::string& arg : args) argv.push_back(const_cast<char*>(arg.c_str()));
  argv.push_back(nullptr);
  execv(FLUIDTEX_PROGRAM, argv.data());
  _exit(127);
}

struct Finished {
  int exitCode = -1;  // -1: ended by a signal
  std::string output;
};

inline Finished waitFor(pid_t child, const std::filesystem::path& output) {
  int status = 0;
  waitpid(child, &status, 0);
  std::ifstream in(output, std::ios::binary);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, {std::istreambuf_iterator<char>(in), {}}};
}

inline Finished runProgram(const std::vector<std::string>& args) {
  std::string name = (std::filesystem::temp_directory_path() / "fluidtex-output-XXXXXX").string();
  close(mkstemp(name.data()));
  Finished finished = waitFor(startProgram(args, name), name);
  std::filesystem::remove(name);
  return finished;
}
