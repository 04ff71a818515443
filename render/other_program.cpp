#include "render/other_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace fluidtex::render {
namespace {

// A file descriptor that is closed by scope.
struct Descriptor {
  int number = -1;
  Descriptor() = default;
  ~Descriptor() { shut(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  void shut() {
    if (number >= 0) close(number);
    number = -1;
  }
};

struct Channel {
  Descriptor here, there;
};

// Adds what has come; false at the end.
bool take(int descriptor, std::string& text) {
  char buffer[4096];
  const ssize_t count = read(descriptor, buffer, sizeof buffer);
  if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && errno == EINTR);
}

// Takes the whole lines off the text and gives them to `line`.
void tellLines(std::string& text, const std::function<void(const std::string&)>& line) {
  if (!line) return;
  for (std::size_t end = text.find('\n'); end != text.npos; end = text.find('\n')) {
    const std::string whole = text.substr(0, end);
    text.erase(0, end + 1);
    line(whole);
  }
}

// Feeds the input and gathers what comes, in whichever order the other program likes, until it says no more,
// or is to be stopped.
void converse(Descriptor& feed, const std::string& input, Descriptor& output, Descriptor& complaints,
              const Meanwhile& meanwhile, Outcome& outcome) {
  constexpr int kTenthOfSecond = 100, kForever = -1;  // ms
  std::size_t fed = 0;
  while (output.number >= 0 || complaints.number >= 0) {
    // A number below 0 is passed over.
    std::array<pollfd, 3> ends{
        {{feed.number, POLLOUT, 0}, {output.number, POLLIN, 0}, {complaints.number, POLLIN, 0}}};
    const int ready = poll(ends.data(), ends.size(), meanwhile.stop ? kTenthOfSecond : kForever);
    if (meanwhile.stop && meanwhile.stop()) return;
    if (ready < 0) {
      if (errno == EINTR) continue;
      break;
    }
    if (ends[0].revents != 0) {
      // No signal where it has closed its end: it has read enough.
      const ssize_t count =
          send(feed.number, input.data() + fed, input.size() - fed, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count > 0) fed += static_cast<std::size_t>(count);
      if (fed == input.size() || (count < 0 && errno != EINTR && errno != EAGAIN)) feed.shut();
    }
    if (ends[1].revents != 0 && !take(output.number, outcome.output)) output.shut();
    if (ends[2].revents != 0 && !take(complaints.number, outcome.complaints)) complaints.shut();
    tellLines(outcome.output, meanwhile.line);
  }
}

// A process of ours that is waited for by scope, and killed before that unless it has ended well.
struct Child {
  pid_t number = 0;
  bool ended = false;
  Child() = default;
  ~Child() {
    if (number > 0 && !ended) wait(true);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  int wait(bool killed) {
    if (killed) kill(number, SIGKILL);
    int status = 0;
    while (waitpid(number, &status, 0) < 0 && errno == EINTR) {
    }
    ended = true;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
};

}  // namespace

Outcome runOther(const std::vector<std::string>& arguments, const std::string& input,
                 const Meanwhile& meanwhile) {
  const auto fail = [&](int error) {
    throw std::runtime_error(arguments[0] + " could not be started: " + std::strerror(error));
  };
  Channel in, out, err;
  const auto open = [&](Channel& channel, const auto& make) {
    int ends[2];
    if (make(ends) != 0) fail(errno);
    channel.here.number = ends[0];
    channel.there.number = ends[1];
  };
  const auto pipeEnds = [](int* ends) { return pipe2(ends, O_CLOEXEC); };
  if (!input.empty())
    open(in, [](int* ends) { return socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends); });
  open(out, pipeEnds);
  open(err, pipeEnds);

  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (input.empty())
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  else
    posix_spawn_file_actions_adddup2(&actions, in.there.number, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.there.number, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.there.number, STDERR_FILENO);
  // It has no need to know that we let no broken pipe end us.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t usual;
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  Child child;
  const int error = posix_spawnp(&child.number, argv[0], &actions, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  for (Channel* channel : {&in, &out, &err}) channel->there.shut();
  if (error != 0) {
    child.ended = true;
    fail(error);
  }

  Outcome outcome;
  converse(in.here, input, out.here, err.here, meanwhile, outcome);
  outcome.exitCode = child.wait(meanwhile.stop && meanwhile.stop());
  return outcome;
}

std::string lastLine(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \r\n");
  if (end == std::string::npos) return "it gave no reason";
  const std::size_t begin = text.find_last_of("\r\n", end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

}  // namespace fluidtex::render
