// What goes over the socket between a program and its fluidtex_reader, one packet at a time. A question is a
// letter (Wanted) and the file's absolute name, behind which there may be a zero and the name of what is
// wanted in the file. The answer are packets of data, or one that says what is wrong, and in any case one at
// the end with how the process that read has ended.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <streambuf>
#include <string_view>

namespace fluidtex::foreign {

enum class Packet : char { data = 'd', wrong = 'w', ended = 'e' };

inline constexpr std::size_t kLongestPacket = 64 << 10;  // bytes behind the letter
inline constexpr int kNoMemory = 3;  // exit code of a process that needs more than it may have

// In as many packets as that takes, at least one; false where nobody listens any more.
bool sendPackets(int socket, char letter, std::string_view bytes);

// Waits for one packet. How many bytes came behind its letter; -1 where the other side has gone.
ssize_t receivePacket(int socket, char& letter, char (&bytes)[kLongestPacket]);

// What is written into it goes out in packets of data; the rest with flush.
class PacketBuffer : public std::streambuf {
 public:
  explicit PacketBuffer(int socket) : m_socket(socket) { clear(); }

 protected:
  int_type overflow(int_type letter) override;
  int sync() override;

 private:
  void clear() { setp(m_bytes.data(), m_bytes.data() + m_bytes.size()); }

  int m_socket;
  std::array<char, kLongestPacket> m_bytes;
};

}  // namespace fluidtex::foreign
