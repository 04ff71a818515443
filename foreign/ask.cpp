#include "foreign/ask.h"

#include "foreign/packets.h"
#include "foreign/program_beside.h"

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
#include <span>
#include <streambuf>
#include <string>

namespace fluidtex::foreign {
namespace {

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
    std::string program = programBeside("fluidtex_reader", FLUIDTEX_READER).string();
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

// One question and what comes back. While it lives no other is asked.
class Answer {
 public:
  Answer(Wanted wanted, const std::filesystem::path& file, const std::string& part) : m_lock(s_one) {
    std::string question = std::filesystem::absolute(file).string();
    if (!part.empty()) (question += '\0') += part;
    if (question.size() > kLongestPacket) throw Unreadable("cannot be read: its name is too long");
    if (s_reader.socket >= 0 && s_reader.startedBy == getpid() &&
        sendPackets(s_reader.socket, char(wanted), question))
      return;
    s_reader.stop();
    s_reader.start();
    sendPackets(s_reader.socket, char(wanted), question);
  }

  // The next piece; nothing behind the last one.
  std::span<char> next() {
    while (!m_ended) {
      char letter = 0;
      const ssize_t got = receivePacket(s_reader.socket, letter, s_bytes);
      if (got < 0) {
        s_reader.stop();
        m_wrong = "cannot be read: the program that reads it was ended from outside";
        m_ended = true;
        break;
      }
      const std::span<char> piece(s_bytes, std::size_t(got));
      if (letter == char(Packet::data) && !piece.empty()) return piece;
      if (letter == char(Packet::wrong)) m_wrong.assign(piece.begin(), piece.end());
      if (letter != char(Packet::ended)) continue;
      m_ended = true;
      if (piece.size() == sizeof m_status) std::memcpy(&m_status, piece.data(), sizeof m_status);
    }
    return {};
  }

  // Takes it up to its end, so that the next question finds the socket empty, and throws what was wrong: what
  // the reader says before the failure that its silence has led to.
  void finish(const std::exception_ptr& failure) {
    while (!m_ended) next();
    if (!m_wrong.empty()) throw Unreadable(m_wrong);
    if (const auto why = complaint(m_status)) throw Unreadable(*why);
    if (failure) std::rethrow_exception(failure);
  }

 private:
  inline static std::mutex s_one;
  inline static Running s_reader;
  inline static char s_bytes[kLongestPacket];

  std::lock_guard<std::mutex> m_lock;
  std::string m_wrong;
  int m_status = 0;
  bool m_ended = false;
};

class AnswerBuffer : public std::streambuf {
 public:
  explicit AnswerBuffer(Answer& answer) : m_answer(answer) {}

 protected:
  int_type underflow() override {
    std::span<char> piece = m_answer.next();
    setg(piece.data(), piece.data(), piece.data() + piece.size());
    return piece.empty() ? traits_type::eof() : traits_type::to_int_type(piece.front());
  }

 private:
  Answer& m_answer;
};

}  // namespace

void ask(Wanted wanted, const std::filesystem::path& file, const std::function<void(std::string_view)>& take,
         const std::string& part) {
  Answer answer(wanted, file, part);
  std::exception_ptr failure;
  try {
    for (auto piece = answer.next(); !piece.empty(); piece = answer.next())
      take({piece.data(), piece.size()});
  } catch (...) {
    failure = std::current_exception();
  }
  answer.finish(failure);
}

void askForStream(Wanted wanted, const std::filesystem::path& file,
                  const std::function<void(std::istream&)>& parse, const std::string& part) {
  Answer answer(wanted, file, part);
  AnswerBuffer buffer(answer);
  std::istream in(&buffer);
  in.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
  std::exception_ptr failure;
  try {
    parse(in);
  } catch (...) {
    failure = std::current_exception();
  }
  answer.finish(failure);
}

}  // namespace fluidtex::foreign
