// A visitor that changes nothing and writes down what it was shown.
#pragma once

#include "scenes/visitor.h"

#include <string>
#include <vector>

namespace fluidtex::scenes {

class Recorder : public Visitor {
 public:
  std::vector<std::string> keys;   // of values, dotted
  std::vector<std::string> calls;  // "enter domain", "leave", ...

  void flag(const std::string& key, bool&) override { see(key); }
  void integer(const std::string& key, int&, const Limits&, Need) override { see(key); }
  void seed(const std::string& key, std::uint64_t&) override { see(key); }
  void number(const std::string& key, double&, const Limits&, Need) override { see(key); }
  void text(const std::string& key, std::string&) override { see(key); }
  void vector(const std::string& key, Vec3d&, const Limits&, Need) override { see(key); }
  void integers(const std::string& key, std::vector<int>&, const Limits&) override { see(key); }
  void pixels(const std::string& key, int&, int&, const Limits&) override { see(key); }
  void file(const std::string& key, std::filesystem::path&, const std::vector<std::string>&) override {
    see(key);
  }
  void files(const std::string& key, std::filesystem::path&, const std::vector<std::string>&) override {
    see(key);
  }
  void picture(const std::string& key, std::filesystem::path&, texture::AnimationOptions&) override {
    see(key);
  }
  void path(const std::string& key, std::filesystem::path&) override { see(key); }
  void choice(const std::string& key, int&, const std::vector<std::string>&) override { see(key); }
  int alternative(int current, const std::vector<std::string>&, Need) override { return current; }
  void absent(const std::string& key) override { see(key + " (absent)"); }
  void enter(const std::string& key, Need) override { open(key); }
  std::size_t enterList(const std::string& key, std::size_t size, Need) override {
    open(key);
    return size;
  }
  void enterMember(std::size_t index) override { open(std::to_string(index)); }
  void leave() override {
    calls.emplace_back("leave");
    m_open.pop_back();
  }

 protected:
  void see(const std::string& key) {
    calls.push_back(key);
    std::string whole;
    for (const std::string& part : m_open) whole += part + ".";
    keys.push_back(whole + key);
  }
  void open(const std::string& key) {
    calls.push_back("enter " + key);
    m_open.push_back(key);
  }

 private:
  std::vector<std::string> m_open;
};

}  // namespace fluidtex::scenes
