// For as long as it lives, this process and those it starts can make no file larger than so many bytes:
// writing beyond that fails, and no signal comes.
#pragma once

#include <sys/resource.h>

#include <csignal>

class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) : m_handler(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &m_before);
    rlimit less = m_before;
    less.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &less);
  }
  ~FileLimit() {
    setrlimit(RLIMIT_FSIZE, &m_before);
    std::signal(SIGXFSZ, m_handler);
  }
  FileLimit(const FileLimit&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;

 private:
  rlimit m_before{};
  void (*m_handler)(int);
};
