// fluidtex_reader: reads files of others for the program that has started it. Questions come on standard
// input, which is a socket, and are answered there (foreign/packets.h); each file is read by a process of its
// own, so that this one outlives them all. The libraries, which take longer to load than most files to read,
// are there once.
#include "foreign/grid_heads.h"
#include "foreign/limits.h"
#include "foreign/packets.h"
#include "foreign/read_grid.h"
#include "foreign/read_picture.h"

#include <OpenImageIO/imageio.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <new>
#include <ostream>
#include <string>

// One, but in the build of the fuzz targets: a process takes longer to start and to end than a small file to
// read.
#ifndef FLUIDTEX_FILES_A_PROCESS
#define FLUIDTEX_FILES_A_PROCESS 1
#endif

namespace {

using namespace fluidtex::foreign;

constexpr int kSocket = STDIN_FILENO;

void say(Packet packet, std::string_view bytes) {
  sendPackets(kSocket, char(packet), bytes);
}

bool isOfGrids(Wanted wanted) {
  switch (wanted) {
    case Wanted::colors:
    case Wanted::numbers:
    case Wanted::heights:
    case Wanted::color_note:
      return false;
    case Wanted::floats:
    case Wanted::vectors:
    case Wanted::grids:
    case Wanted::named_floats:
    case Wanted::named_vectors:
      return true;
  }
  return false;
}

void answer(Wanted wanted, const std::filesystem::path& file, const std::string& part) {
  PacketBuffer buffer(kSocket);
  std::ostream out(&buffer);
  out.exceptions(std::ios::badbit | std::ios::failbit);
  switch (wanted) {
    case Wanted::colors:
    case Wanted::numbers:
    case Wanted::heights: {
      const Picture picture = here::readPicture(file, wanted);
      const PictureHead& head = picture;
      say(Packet::data, {reinterpret_cast<const char*>(&head), sizeof head});
      say(Packet::data, picture.samples);
      break;
    }
    case Wanted::color_note:
      say(Packet::data, here::colorNote(file));
      break;
    case Wanted::floats:
    case Wanted::vectors:
      here::readGrid(file, wanted == Wanted::vectors, out);
      break;
    case Wanted::grids:
      say(Packet::data, packed(here::listGrids(file)));
      break;
    case Wanted::named_floats:
    case Wanted::named_vectors:
      here::readGrid(file, part, wanted == Wanted::named_vectors, out);
      break;
  }
  out.flush();
}

// `question`: the name of a file, and behind a zero what is wanted in it.
void read(Wanted wanted, const std::string& question) {
  const std::size_t end = std::min(question.find('\0'), question.size());
  const std::filesystem::path file = question.substr(0, end);
  const std::string part = question.substr(std::min(end + 1, question.size()));
  limitThisProcess(file, isOfGrids(wanted) ? here::mostMemoryOfGrid(file) : kMostMemory);
  try {
    answer(wanted, file, part);
  } catch (const Unreadable& error) {
    say(Packet::wrong, error.what());
  } catch (const std::bad_alloc&) {
    _exit(kNoMemory);
  } catch (const std::exception& error) {
    say(Packet::wrong, "cannot be read: " + asClause(error.what()));
  }
}

void sayEnded(int status) {
  say(Packet::ended, {reinterpret_cast<const char*>(&status), sizeof status});
}

// In a process of its own, which goes on to further questions where it may read more than one file. How it
// ends is said by the one that has started it.
[[noreturn]] void readAndEnd(Wanted wanted, const std::string& question) {
  read(wanted, question);
  for (int more = FLUIDTEX_FILES_A_PROCESS - 1; more > 0; --more) {
    sayEnded(0);
    static char bytes[kLongestPacket];
    char letter = 0;
    const ssize_t size = receivePacket(kSocket, letter, bytes);
    if (size < 0) break;
    read(Wanted(letter), std::string(bytes, std::size_t(size)));
  }
  _exit(0);  // Nothing of the libraries' needs to be tidied up.
}

// What a program has made of its signals is left to its children.
void useOwnSignals() {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal :
       {SIGALRM, SIGXCPU, SIGXFSZ, SIGCHLD, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTERM})
    std::signal(signal, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);  // The terminal's goes to all; what it means is the program's to say.
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace

int main() {
  useOwnSignals();
  // A process that has forked has no threads but one.
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  // What is made with the first file is made once, and not by each process: the list of readers, the tables
  // that some load when they look at a file, and OpenVDB's kinds of grids.
  OIIO::get_string_attribute("format_list");
  OIIO::ImageInput::open("/dev/null");
  OIIO::geterror();
  here::prepareForGrids();
  static char bytes[kLongestPacket];
  for (;;) {
    char letter = 0;
    const ssize_t size = receivePacket(kSocket, letter, bytes);
    if (size < 0) return 0;
    const std::string question(bytes, std::size_t(size));
    int status = 0;
    const pid_t child = fork();
    if (child == 0) readAndEnd(Wanted(letter), question);
    if (child < 0) say(Packet::wrong, "cannot be read: no process can be started for it");
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    sayEnded(status);
  }
}
