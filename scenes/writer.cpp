#include "scenes/writer.h"

#include "scenes/schema.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace fluidtex::scenes {

namespace {

using Json = nlohmann::ordered_json;

class Writer : public Visitor {
 public:
  explicit Writer(Json& root) : m_open{&root} {}

  void flag(const std::string& key, bool& value) override { put(key, value); }
  void integer(const std::string& key, int& value, const Limits&, Need) override { put(key, value); }
  void seed(const std::string& key, std::uint64_t& value) override { put(key, value); }
  void number(const std::string& key, double& value, const Limits&, Need) override {
    put(key, std::isfinite(value) ? Json(value) : Json());
  }
  void text(const std::string& key, std::string& value) override { put(key, value); }
  void vector(const std::string& key, Vec3d& value, const Limits&, Need) override {
    put(key, Json::array({value[0], value[1], value[2]}));
  }
  void integers(const std::string& key, std::vector<int>& value, const Limits&) override { put(key, value); }
  void pixels(const std::string& key, int& width, int& height, const Limits&) override {
    put(key, Json::array({width, height}));
  }
  void file(const std::string& key, std::filesystem::path& value, const std::vector<std::string>&) override {
    // Absolute, so that it says the same wherever the scene is read from.
    put(key,
        value.empty() ? Json() : Json(std::filesystem::absolute(value).lexically_normal().generic_string()));
  }
  void picture(const std::string& key, std::filesystem::path& value,
               texture::AnimationOptions& sequence) override {
    file(key, sequence.pattern.empty() ? value : sequence.pattern, {});
  }
  void path(const std::string& key, std::filesystem::path& value) override { file(key, value, {}); }
  void files(const std::string& key, std::filesystem::path& value,
             const std::vector<std::string>& endings) override {
    file(key, value, endings);
  }
  void choice(const std::string& key, int& value, const std::vector<std::string>& words) override {
    put(key, words[std::size_t(value)]);
  }
  int alternative(int current, const std::vector<std::string>&, Need) override { return current; }
  void absent(const std::string& key) override { put(key, Json()); }
  void enter(const std::string& key, Need) override { m_open.push_back(&put(key, Json::object())); }
  std::size_t enterList(const std::string& key, std::size_t size, Need) override {
    // All members at once: entering one must not move the others.
    m_open.push_back(&put(key, Json(size, Json::object())));
    return size;
  }
  void enterMember(std::size_t index) override { m_open.push_back(&(*m_open.back())[index]); }
  void leave() override { m_open.pop_back(); }

 private:
  Json& put(const std::string& key, Json value) { return (*m_open.back())[key] = std::move(value); }

  std::vector<Json*> m_open;  // the root and the tables and lists that were entered
};

}  // namespace

std::string resolvedText(Scene scene, Quality quality) {
  Json root = Json::object();
  root["quality"] = nameOf(quality);
  Writer writer(root);
  describe(writer, scene);
  // A path may hold bytes that are no UTF-8.
  return root.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace fluidtex::scenes
