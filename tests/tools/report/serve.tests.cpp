#include "tests/scratch.h"
#include "tests/tools/formats/sample_surface.h"
#include "tests/tools/program.h"
#include "tools/formats/ply.h"
#include "tools/run_folder/report.h"

#include <arpa/inet.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <catch2/catch.hpp>

#include <csignal>

using namespace fluidtex;
using namespace fluidtex::tools;
using Catch::Matchers::Contains;

namespace {

// A port that was free a moment ago.
int freePort() {
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  REQUIRE(bind(descriptor, reinterpret_cast<sockaddr*>(&address), size) == 0);
  REQUIRE(getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) == 0);
  close(descriptor);
  return ntohs(address.sin_port);
}

// fluidtex view OUT, until the end of this object.
struct Viewed {
  int port = freePort();
  RunningProgram program;
  httplib::Client client;
  explicit Viewed(const std::filesystem::path& out)
      : program({"view", out.string(), "--port", std::to_string(port)}), client("127.0.0.1", port) {
    for (int tries = 0; tries < 500 && !client.Get("/"); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ~Viewed() {
    program.signal(SIGTERM);
    program.wait();
  }
  int status(const std::string& path) {
    const httplib::Result result = client.Get(path);
    return result ? result->status : 0;
  }
};

void writeRun(const std::filesystem::path& out) {
  std::filesystem::create_directories(out / "surface");
  std::filesystem::create_directories(out / "frames");
  writePly(sampleSurface(), {}, out / "surface/0002.ply");
  std::ofstream(out / "frames/0002.png") << "picture";
  std::ofstream(out / "small.mp4") << "0123456789";
  std::ofstream(out / "run.json")
      << R"({"version": "1", "scene": {"name": "small", "frames": 5, "texture": {}},
                                         "frames": [{"frame": 2, "time": 0.5, "vertices": 4}]})";
}

}  // namespace

TEST_CASE("view: the run as it is, its files by number, and nothing else", "[tools]") {
  const Scratch scratch;
  const std::filesystem::path out = scratch.path / "a & ü %2e";
  writeRun(out);
  std::ofstream(scratch.path / "secret.png") << "secret";
  Viewed viewed(out);
  const auto page = viewed.client.Get("/");
  REQUIRE(page);
  CHECK(page->status == 200);
  CHECK_THAT(page->body, Contains("</html>"));
  const auto run = viewed.client.Get("/run");
  REQUIRE(run);
  const Json json = Json::parse(run->body);
  CHECK(json["title"] == "small");
  CHECK(json["pictures"] == Json::parse("[2]"));
  CHECK(json["meshes"] == Json::parse("[2]"));
  CHECK(json["video"]["bytes"] == 10);
  CHECK(viewed.client.Get("/frames/2.png")->body == "picture");
  CHECK(viewed.client.Get("/mesh/2")->body.size() > 40);
  const auto part = viewed.client.Get("/video", {httplib::make_range_header({{2, 4}})});
  CHECK(part->status == 206);
  CHECK(part->body == "234");
  for (const char* path : {"/frames/3.png", "/mesh/3", "/run.json", "/frames/", "/frames/../run.json",
                           "/frames/..%2frun.json", "/frames/../../secret.png", "/../secret.png", "/mesh/-1",
                           "/mesh/99999999999", "/frames/0002.png/../../run.json", "/favicon.ico"})
    CHECK(std::pair(path, viewed.status(path)) == std::pair(path, 404));
  CHECK(viewed.client.Post("/run", "x", "text/plain")->status == 404);
}

TEST_CASE("view: a page elsewhere that leads its own name here gets nothing", "[tools]") {
  const Scratch scratch;
  writeRun(scratch.path);
  Viewed viewed(scratch.path);
  CHECK(viewed.client.Get("/run", {{"Host", "evil.example:" + std::to_string(viewed.port)}})->status == 403);
  CHECK(viewed.client.Get("/run", {{"Host", "localhost:" + std::to_string(viewed.port)}})->status == 200);
}

TEST_CASE("view: before the first frame, and as frames come", "[tools]") {
  const Scratch scratch;
  Viewed viewed(scratch.path);
  CHECK(Json::parse(viewed.client.Get("/run")->body)["frames"].empty());
  writeRun(scratch.path);
  CHECK(Json::parse(viewed.client.Get("/run")->body)["frames"].size() == 1);
  std::ofstream(scratch.path / "run.json") << "{ half";
  const auto broken = viewed.client.Get("/run");
  CHECK(broken->status == 500);
  CHECK_THAT(broken->body, Contains("run.json"));
}

TEST_CASE("view: a folder that is not there, and a port that is taken, are one sentence", "[tools]") {
  const Scratch scratch;
  const Finished missing = runProgram({"view", (scratch.path / "none").string()});
  CHECK(missing.exitCode == 1);
  CHECK_THAT(missing.err, Contains("none") && Contains("give the folder of a run"));
  writeRun(scratch.path);
  Viewed viewed(scratch.path);
  const Finished taken = runProgram({"view", scratch.path.string(), "--port", std::to_string(viewed.port)});
  CHECK(taken.exitCode == 1);
  CHECK_THAT(taken.err, Contains("--port " + std::to_string(viewed.port)));
}
