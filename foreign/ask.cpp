#include "foreign/ask.h"

#include "foreign/packets.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>
#include <string>

namespace fluidtex::foreign {
namespace {

// Beside the program that asks, or else where it was built.
std::filesystem::path readerProgram() {
  std::error_code ignored;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path beside = self.parent_path() / "fluidtex_reader";
  return std::filesystem::exists(beside, ignored) ? beside : std::filesystem::path(FLUIDTEX_READER);
}

// The reader that runs, if any; it ends when its socket is closed, which the end of this program does too.
struct Running {
  int socket = -1;
  pid_t process = -1, startedBy = -1;

  void stop() {
    if (socket >= 0) close(socket);
    // A program that has forked has the socket of its parent's reader, which is not its child.
    if (process > 0 && startedBy == getpid()) waitpid(process, nullptr, 0);
    *this = {};
  }

  void start() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
      throw Unreadable(std::string("cannot be read: no socket (") + std::strerror(errno) + ")");
    // Where a program's standard streams are closed, a socket could take the place of one, and be printed to.
    for (int& end : ends) {
      if (end > STDERR_FILENO) continue;
      const int higher = fcntl(end, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
      close(end);
      end = higher;
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
    std::string program = readerProgram().string();
    char* const arguments[] = {program.data(), nullptr};
    pid_t started = -1;
    const int error = posix_spawn(&started, program.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (error != 0) {
      close(ends[0]);
      throw Unreadable("cannot be read: the program that reads it, " + program + ", does not start (" +
                       std::strerror(error) + ")");
    }
    *this = {ends[0], started, getpid()};
  }
};

// What the end of the process that read means, where it is no good one.
std::optional<std::string> complaint(int status) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoMemory)
    return "cannot be read: that takes more memory than a file of its size warrants, or than 1.5 GB";
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGKILL) return "cannot be read: its reader was killed, perhaps for lack of memory";
    if (signal == SIGXCPU || signal == SIGALRM)
      return "cannot be read: that takes too long for a file of its size";
    return std::string("cannot be read: the library that reads such files crashes on it (") +
           strsignal(signal) + ")";
  }
  return "cannot be read: the program that reads it failed";
}

}  // namespace

void ask(Wanted wanted, const std::filesystem::path& file,
         const std::function<void(std::string_view)>& take) {
  static std::mutex one;
  static Running reader;
  const std::lock_guard lock(one);
  const std::string name = std::filesystem::absolute(file).string();
  if (name.size() > kLongestPacket) throw Unreadable("cannot be read: its name is too long");
  if (reader.socket < 0 || reader.startedBy != getpid() || !sendPackets(reader.socket, char(wanted), name)) {
    reader.stop();
    reader.start();
    sendPackets(reader.socket, char(wanted), name);
  }
  // The answer is taken up to its end whatever happens, so that the next question finds the socket empty.
  static char bytes[kLongestPacket];
  std::string wrong;
  std::exception_ptr failure;
  int status = 0;
  for (char letter = 0; letter != char(Packet::ended);) {
    const ssize_t size = receivePacket(reader.socket, letter, bytes);
    if (size < 0) {
      reader.stop();
      throw Unreadable("cannot be read: the program that reads it was ended from outside");
    }
    const std::string_view piece(bytes, std::size_t(size));
    if (letter == char(Packet::wrong)) wrong = piece;
    if (letter == char(Packet::ended) && piece.size() == sizeof status)
      std::memcpy(&status, piece.data(), sizeof status);
    if (letter != char(Packet::data) || failure) continue;
    try {
      take(piece);
    } catch (...) {
      failure = std::current_exception();
    }
  }
  if (!wrong.empty()) throw Unreadable(wrong);
  if (const auto why = complaint(status)) throw Unreadable(*why);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace fluidtex::foreign
