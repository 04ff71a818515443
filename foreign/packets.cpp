#include "foreign/packets.h"

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <cerrno>

namespace fluidtex::foreign {

bool sendPackets(int socket, char letter, std::string_view bytes) {
  do {
    const std::string_view piece = bytes.substr(0, kLongestPacket);
    bytes.remove_prefix(piece.size());
    iovec parts[2] = {{&letter, 1}, {const_cast<char*>(piece.data()), piece.size()}};
    msghdr message{};
    message.msg_iov = parts;
    message.msg_iovlen = 2;
    while (sendmsg(socket, &message, MSG_NOSIGNAL) < 0)
      if (errno != EINTR) return false;
  } while (!bytes.empty());
  return true;
}

ssize_t receivePacket(int socket, char& letter, char (&bytes)[kLongestPacket]) {
  iovec parts[2] = {{&letter, 1}, {bytes, kLongestPacket}};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = 2;
  ssize_t got = -1;
  do got = recvmsg(socket, &message, 0);
  while (got < 0 && errno == EINTR);
  return got < 1 ? -1 : got - 1;
}

PacketBuffer::int_type PacketBuffer::overflow(int_type letter) {
  if (sync() != 0) return traits_type::eof();
  if (!traits_type::eq_int_type(letter, traits_type::eof())) sputc(traits_type::to_char_type(letter));
  return traits_type::not_eof(letter);
}

int PacketBuffer::sync() {
  const std::string_view bytes(pbase(), std::size_t(pptr() - pbase()));
  clear();
  return bytes.empty() || sendPackets(m_socket, char(Packet::data), bytes) ? 0 : -1;
}

}  // namespace fluidtex::foreign
