// How Blender is asked and heard, by one that only writes down what it is told; what it draws is in
// tests/blender/render.tests.py.
#include "tools/draw_by_cycles.h"

#include "scenes/writer.h"
#include "tests/scratch.h"
#include "tools/base/errors.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>
#include <thread>

namespace fs = std::filesystem;
using namespace fluidtex;
using namespace fluidtex::tools;
using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;

namespace {

// PATH begins with a folder in which `blender` keeps what it is asked for and its arguments, and then does as
// the shell script says.
class PretendedBlender {
 public:
  explicit PretendedBlender(const std::string& script) : m_path(std::getenv("PATH")) {
    scene.resolved = scenes::resolvedText(scene, scenes::Quality::standard);
    scene.render.width = 2;
    scene.render.height = 1;
    scene.render.samples = 8;
    const fs::path program = scratch.path / "bin" / "blender";
    fs::create_directories(program.parent_path());
    fs::create_directories(scratch.path / "pictures");
    std::ofstream(program) << "#!/bin/sh\ncd '" << scratch.path.string()
                           << "'\ncat > asked.json\necho \"$@\" > arguments\n"
                           << script;
    fs::permissions(program, fs::perms::owner_all);
    setenv("PATH", (program.parent_path().string() + ":" + m_path).c_str(), 1);
  }
  ~PretendedBlender() { setenv("PATH", m_path.c_str(), 1); }
  PretendedBlender(const PretendedBlender&) = delete;
  PretendedBlender& operator=(const PretendedBlender&) = delete;

  // A picture as it would be drawn, of such values.
  void writeLight(const std::string& name, const std::vector<float>& values) const {
    std::ofstream(scratch.path / "pictures" / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(values.data()), std::streamsize(4 * values.size()));
  }
  void draw(const std::vector<int>& frames, const CyclesReceiver& receiver, const CyclesOptions& options = {},
            int threads = 0) const {
    drawByCycles(scene, scratch.path / "run", frames, options, threads, scratch.path / "pictures", receiver);
  }
  nlohmann::json asked() const { return nlohmann::json::parse(readBytes(scratch.path / "asked.json")); }
  std::string arguments() const { return readBytes(scratch.path / "arguments"); }

  Scratch scratch;
  scenes::Scene scene;

 private:
  std::string m_path;
};

CyclesReceiver deaf() {
  return {[](int, const render::Picture&) {}, {}, {}};
}

}  // namespace

TEST_CASE("draw by cycles: pictures and progress come as they are told", "[tools]") {
  PretendedBlender blender(
      "echo 'Fra:7 Mem:20.1M (Peak 21M) | Time:00:00.10 | Sample 2/8'\n"
      "echo 'frame 7'\necho 'Blender says anything'\n"
      "echo 'Fra:9 Mem:20.1M | Sample 8/8'\necho 'frame 9'\n");
  blender.writeLight("0007.light", {0.0f, 0.5f, 1.0f, 1.5f, 2.0f, 2.5f});
  blender.writeLight("0009.light", std::vector<float>(6, 3.0f));
  std::vector<std::pair<int, std::vector<float>>> pictures;
  std::vector<std::pair<int, double>> progress;
  blender.draw({7, 9},
               {[&](int frame, const render::Picture& picture) {
                  CHECK((picture.width == 2 && picture.height == 1));
                  pictures.emplace_back(frame, picture.rgb);
                },
                [&](int frame, double part) { progress.emplace_back(frame, part); }, [] { return false; }});
  REQUIRE(pictures.size() == 2);
  CHECK(pictures[0] == std::pair{7, std::vector<float>{0.0f, 0.5f, 1.0f, 1.5f, 2.0f, 2.5f}});
  CHECK(pictures[1] == std::pair{9, std::vector<float>(6, 3.0f)});
  CHECK(progress == std::vector<std::pair<int, double>>{{7, 0.25}, {9, 1.0}});
  // They are taken away.
  CHECK(filesIn(blender.scratch.path / "pictures").empty());
}

TEST_CASE("draw by cycles: all that is wished for is asked for", "[tools]") {
  PretendedBlender blender("echo 'frame 3'\n");
  blender.scene.domainOrigin = sim::Vec3d(1.0, 2.0, 3.0);
  blender.writeLight("0003.light", std::vector<float>(6));
  blender.draw({3}, deaf());
  nlohmann::json asked = blender.asked();
  CHECK(asked["run"] == (blender.scratch.path / "run").string());
  CHECK(asked["pictures"] == (blender.scratch.path / "pictures").string());
  CHECK(asked["scene"] == nlohmann::json::parse(blender.scene.resolved));
  CHECK(asked["origin"] == nlohmann::json({1.0, 2.0, 3.0}));
  CHECK(asked["frames"] == nlohmann::json({3}));
  CHECK(asked["shutter"] == 0.0);
  CHECK(asked["shader"] == "coat");
  CHECK(asked["maps"].empty());
  CHECK(asked["height"].is_null());
  CHECK(asked["blend"].is_null());
  CHECK_THAT(blender.arguments(), StartsWith("-b --factory-startup ") && Contains("--python-exit-code 1") &&
                                      !Contains("-t ") &&
                                      EndsWith("-P " + (blenderScripts() / "render.py").string() + "\n"));

  CyclesOptions options;
  options.shutter = 0.5;
  options.shader = "principled";
  options.maps["bump"] = "bump.png";
  options.height = 0.25;
  blender.writeLight("0003.light", std::vector<float>(6));
  blender.draw({3}, deaf(), options, 3);
  asked = blender.asked();
  CHECK(asked["shutter"] == 0.5);
  CHECK(asked["shader"] == "principled");
  CHECK(asked["maps"] == nlohmann::json{{"bump", fs::absolute("bump.png").string()}});
  CHECK(asked["height"] == 0.25);
  CHECK_THAT(blender.arguments(), Contains(" -t 3 "));
}

TEST_CASE("draw by cycles: what our own script finds wrong is the user's to mend, all else a failure",
          "[tools]") {
  const auto drawn = [](const std::string& script) {
    PretendedBlender blender(script);
    blender.writeLight("0001.light", std::vector<float>(5));
    blender.draw({1}, deaf());
  };
  CHECK_THROWS_AS(drawn("echo 'noise' >&2\necho 'error: a.png: is torn' >&2\nexit 1\n"), UsageError);
  CHECK_THROWS_WITH(drawn("echo 'error: a.png: is torn' >&2\nexit 1\n"), "a.png: is torn");
  CHECK_THROWS_WITH(drawn("echo 'no more memory' >&2\nexit 1\n"), "blender: no more memory");
  CHECK_THROWS_WITH(drawn("exit 0\n"), "blender: has ended before all pictures were drawn");
  CHECK_THROWS_WITH(drawn("echo 'frame 1'\n"), Contains("0001.light is not of 2 x 1 pixels"));
}

TEST_CASE("draw by cycles: it is interrupted once it is to stop", "[tools]") {
  PretendedBlender blender("exec sleep 60\n");
  CyclesReceiver receiver = deaf();
  receiver.stop = [] { return true; };
  const auto start = std::chrono::steady_clock::now();
  CHECK_THROWS_AS(blender.draw({1}, receiver), Interrupted);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(30));
}

TEST_CASE("draw by cycles: a file of Blender's is whole or not there", "[tools]") {
  const auto saved = [](const std::string& script) {
    PretendedBlender blender(script);
    const fs::path file = blender.scratch.path / "scene.blend";
    try {
      saveForBlender(blender.scene, blender.scratch.path / "run", {}, file);
    } catch (const std::exception&) {
    }
    const nlohmann::json asked = blender.asked();
    CHECK(asked["frames"].empty());
    CHECK(asked["pictures"].is_null());
    CHECK(fs::path(asked["blend"].get<std::string>()).parent_path() == blender.scratch.path);
    CHECK(asked["blend"] != file.string());
    return readBytes(file);
  };
  const std::string write =
      "echo saved > \"$(sed -n 's/.*\"blend\":\"\\([^\"]*\\)\".*/\\1/p' asked.json)\"\n";
  CHECK(saved(write) == "saved\n");
  CHECK(saved(write + "exit 1\n").empty());
}

TEST_CASE("draw by cycles: a machine without Blender is told so", "[tools]") {
  PretendedBlender blender("exit 0\n");
  fs::remove(blender.scratch.path / "bin" / "blender");
  fs::create_directory(blender.scratch.path / "bin" / "blender");
  setenv("PATH", (blender.scratch.path / "bin").c_str(), 1);
  CHECK_THROWS_WITH(blender.draw({1}, deaf()), StartsWith("--cycles: blender is not installed"));
}

TEST_CASE("draw by cycles: the scripts are those of the sources, where none are installed beside the program",
          "[tools]") {
  CHECK(fs::equivalent(blenderScripts(), FLUIDTEX_SOURCE "/tools/blender"));
  CHECK(fs::exists(blenderScripts() / "fluidtex.py"));
}
