#include "foreign/packets.h"

#include <sys/socket.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <ostream>
#include <string>
#include <thread>
#include <vector>

using namespace fluidtex::foreign;

namespace {

struct Sockets {
  int here = -1, there = -1;
  Sockets() {
    int both[2];
    REQUIRE(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, both) == 0);
    here = both[0];
    there = both[1];
  }
  ~Sockets() {
    close(here);
    leave();
  }
  Sockets(const Sockets&) = delete;
  Sockets& operator=(const Sockets&) = delete;
  void leave() {
    if (there >= 0) close(there);
    there = -1;
  }
};

struct Received {
  char letter = '?';
  std::string bytes;
};

// Its size is that of the text; nothing where the other side has gone.
std::vector<Received> received(int socket, int most) {
  std::vector<Received> all;
  static char bytes[kLongestPacket];
  for (int n = 0; n < most; ++n) {
    Received one;
    const ssize_t got = receivePacket(socket, one.letter, bytes);
    if (got < 0) break;
    one.bytes.assign(bytes, std::size_t(got));
    all.push_back(one);
  }
  return all;
}

std::string counted(std::size_t size) {
  std::string text(size, '\0');
  for (std::size_t i = 0; i < size; ++i) text[i] = char(i * 31 % 251);
  return text;
}

}  // namespace

TEST_CASE("packets: a letter and bytes come as they were sent, zeros and none among them", "[foreign]") {
  const Sockets sockets;
  const std::string text("a\0b", 3);
  CHECK(sendPackets(sockets.here, char(Packet::wrong), text));
  CHECK(sendPackets(sockets.here, char(Packet::ended), ""));
  const std::vector<Received> all = received(sockets.there, 2);
  REQUIRE(all.size() == 2);
  CHECK(all[0].letter == 'w');
  CHECK(all[0].bytes == text);
  CHECK(all[1].letter == 'e');
  CHECK(all[1].bytes.empty());
}

TEST_CASE("packets: what is longer than one comes in several, each with the letter", "[foreign]") {
  for (const auto& [size, packets] : {std::pair<std::size_t, std::size_t>{kLongestPacket, 1},
                                      {kLongestPacket + 1, 2},
                                      {5 * kLongestPacket - 1, 5}}) {
    const Sockets sockets;
    const std::string text = counted(size);
    // They do not all fit into the socket: they are sent while they are taken.
    bool sent = false;
    std::thread sender([&, there = sockets.here] { sent = sendPackets(there, 'd', text); });
    const std::vector<Received> all = received(sockets.there, int(packets));
    sender.join();
    CHECK(sent);
    REQUIRE(all.size() == packets);
    std::string together;
    for (const Received& one : all) {
      CHECK(one.letter == 'd');
      CHECK(one.bytes.size() <= kLongestPacket);
      together += one.bytes;
    }
    CHECK((together == text));
  }
}

TEST_CASE("packets: where nobody listens any more, both sides are told, and no signal ends them",
          "[foreign]") {
  Sockets sockets;
  CHECK(sendPackets(sockets.there, 'd', "last"));
  sockets.leave();
  // What was sent before is still there.
  const std::vector<Received> all = received(sockets.here, 2);
  REQUIRE(all.size() == 1);
  CHECK(all[0].bytes == "last");
  CHECK_FALSE(sendPackets(sockets.here, 'd', "nobody"));
}

TEST_CASE("packets: a stream goes out as it fills its packet, and the rest with flush", "[foreign]") {
  Sockets sockets;
  PacketBuffer buffer(sockets.here);
  std::ostream out(&buffer);
  const std::string text = counted(kLongestPacket + 10);
  out << text.substr(0, 5) << std::flush << std::flush << text.substr(5);
  std::vector<Received> all = received(sockets.there, 2);
  REQUIRE(all.size() == 2);
  CHECK(all[0].bytes == text.substr(0, 5));
  CHECK(all[1].bytes.size() == kLongestPacket);
  char none = 0;
  CHECK(recv(sockets.there, &none, 1, MSG_DONTWAIT | MSG_PEEK) < 0);
  out << std::flush;
  const std::vector<Received> rest = received(sockets.there, 1);
  all.insert(all.end(), rest.begin(), rest.end());
  std::string together;
  for (const Received& one : all) {
    CHECK(one.letter == char(Packet::data));
    together += one.bytes;
  }
  CHECK((together == text));
  sockets.leave();
  out << "nobody" << std::flush;
  CHECK_FALSE(out.good());
}
