// What fluidtex check says of a cache.
#include "tools/check_cache.h"

#include "tests/tools/balls.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <numbers>

namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST_CASE("caches: check tells displacement over velocity, and how many points there will be", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls", figures = scratch.path / "figures.json";
  fs::create_directory(cache);
  for (const double factor : {1.0, 1.3, 0.8}) {
    INFO(factor);
    writeBalls(cache, 5, 1.2, factor * 1.2);
    const Finished check = runProgram({"check", cache.string(), "--pairs", "2", "--json", figures.string(),
                                       "--set", "texture.points=5000"});
    INFO(check.all());
    REQUIRE(check.exitCode == 0);
    CHECK(check.err.empty());
    CHECK(check.out.find("; displacement over velocity ") != std::string::npos);
    CHECK(check.out.find("points    one every 0.01 m: about 5000 in frame 1\n") != std::string::npos);
    const Json found = Json::parse(readBytes(figures));
    REQUIRE(found["pairs"].size() == 2);
    CHECK(found["pairs"][1]["from"] == 4);
    for (const Json& pair : found["pairs"]) {
      CHECK(pair["ratio"].get<double>() == Approx(1.0 / factor).epsilon(0.01));
      CHECK(pair["fastest"].get<double>() == Approx(factor * 1.2));
      CHECK(pair["area"].get<double>() == Approx(0.16 * std::numbers::pi).epsilon(0.01));
      // Of a distance that is right by 1 / factor the rest is left.
      const double left = 1.0 - factor;
      CHECK(pair["explained"].get<double>() == Approx(1.0 - left * left).margin(0.03));
    }
  }
}

TEST_CASE("check cache: as many pairs as asked for, evenly taken, or all there are", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls", figures = scratch.path / "figures.json";
  fs::create_directory(cache);
  writeBalls(cache, 5, 1.2, 1.2);
  const auto begins = [&](const char* pairs, const char* frames) {
    const Finished check = runProgram(
        {"check", cache.string(), "--pairs", pairs, "--frames", frames, "--json", figures.string()});
    INFO(check.all());
    REQUIRE(check.exitCode == 0);
    std::vector<int> numbers;
    const Json found = Json::parse(readBytes(figures));
    for (const Json& pair : found["pairs"]) {
      numbers.push_back(pair["from"].get<int>());
      CHECK(pair["to"] == numbers.back() + 1);
    }
    CHECK(occurrences(check.out, "\nmotion ") == long(numbers.size()));
    return numbers;
  };
  CHECK(begins("3", "1:5") == std::vector<int>{1, 2, 4});
  CHECK(begins("1", "2:5") == std::vector<int>{2});
  CHECK(begins("99", "2:5") == std::vector<int>{2, 3, 4});
  CHECK(begins("5", "3:3").empty());
}

TEST_CASE("check cache: a surface that hardly moves tells nothing, and an empty frame has none", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls", figures = scratch.path / "figures.json";
  fs::create_directory(cache);
  writeBalls(cache, 3, 0.0, 0.0);
  std::ofstream(cache / "ball_0003.ply").close();
  const Finished check = runProgram({"check", cache.string(), "--json", figures.string()});
  INFO(check.all());
  REQUIRE(check.exitCode == 0);
  CHECK_THAT(check.out,
             Catch::Contains("motion    1 to 2: speeds up to 0.00 m/s; the surface moves too little"));
  CHECK_THAT(check.out, Catch::Contains("motion    2 to 3: no surface, or no velocity"));
  const Json pairs = Json::parse(readBytes(figures))["pairs"];
  REQUIRE(pairs.size() == 1);
  for (const char* unknown : {"moved", "left", "explained", "bulk", "ratio"})
    CHECK(pairs[0][unknown].is_null());
  // A mesh of 24 x 48 faces is in its level set to a small part of a cell.
  CHECK(pairs[0]["offset"].get<double>() < 0.1);
  // The ball lies about 0, and its first vertex is its highest point.
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(pairs[0]["low"][axis].get<double>() == Approx(-0.2).margin(0.001));
    CHECK(pairs[0]["high"][axis].get<double>() == Approx(0.2).margin(0.001));
  }
  REQUIRE(pairs[0]["first"].size() == 3);
  CHECK(pairs[0]["first"][0][2].get<double>() == Approx(0.2));
}

TEST_CASE("check cache: the most points are told of where there are more than at first", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls", larger = scratch.path / "larger";
  fs::create_directory(cache);
  fs::create_directory(larger);
  writeBalls(cache, 1, 1.2, 1.2);
  // From the second frame on there are two, apart.
  writeBalls(larger, 3, 1.2, 1.2);
  const auto doubled = [](const std::string& ply) {
    const std::size_t body = ply.find("end_header\n") + 11;
    constexpr int kVertices = 25 * 48, kFaces = 24 * 48;
    std::istringstream lines(ply.substr(body));
    std::string vertices, faces, line, head = ply.substr(0, body);
    for (int n = 0; n < kVertices; ++n) {
      std::getline(lines, line);
      const std::size_t first = line.find(' '), second = line.find(' ', first + 1);
      const double y = std::stod(line.substr(first + 1)) + 1.0;
      vertices += line + "\n";
      faces += line.substr(0, first) + " " + std::to_string(y) + line.substr(second) + "\n";
    }
    vertices += faces;
    faces.clear();
    for (int n = 0; n < kFaces; ++n) {
      std::getline(lines, line);
      std::istringstream corners(line);
      int count = 0;
      corners >> count;
      faces += line + "\n";
      std::string other = std::to_string(count);
      for (int corner = 0; corners >> corner;) other += " " + std::to_string(corner + kVertices);
      faces += other + "\n";
    }
    head.replace(head.find("vertex " + std::to_string(kVertices)), 7 + std::to_string(kVertices).size(),
                 "vertex " + std::to_string(2 * kVertices));
    head.replace(head.find("face " + std::to_string(kFaces)), 5 + std::to_string(kFaces).size(),
                 "face " + std::to_string(2 * kFaces));
    return head + vertices + faces;
  };
  for (const char* name : {"ball_0002.ply", "ball_0003.ply"})
    std::ofstream(cache / name) << doubled(readBytes(larger / name));
  const Finished check =
      runProgram({"check", cache.string(), "--set", "texture.spacing=0.01", "--pairs", "2"});
  INFO(check.all());
  REQUIRE(check.exitCode == 0);
  CHECK_THAT(check.out,
             Catch::Contains("points    one every 0.01 m: about 5000 in frame 1, and the most, 10000, "
                             "in frame 2 of those above\n"));
}

TEST_CASE("check cache: without velocities it says so, and a run's own frames need no comparing", "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "blocks", own = scratch.path / "own",
                 figures = scratch.path / "figures.json";
  fs::create_directory(cache);
  for (const char* name : {"block_1.obj", "block_2.obj"})
    std::ofstream(cache / name) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const auto pairs = [&](const fs::path& of, std::vector<std::string> more) {
    fs::remove(figures);
    more.insert(more.begin(), {"check", of.string(), "--json", figures.string()});
    const Finished check = runProgram(more);
    INFO(check.all());
    REQUIRE(check.exitCode == 0);
    CHECK(Json::parse(readBytes(figures))["pairs"].empty());
    return check.all();
  };
  CHECK_THAT(pairs(cache, {}), Catch::Contains("warning: no velocities were found"));
  CHECK_THAT(pairs(cache, {"--set", "files.fit=true"}),
             Catch::Contains("fitted to the surfaces") && !Catch::Contains("warning"));
  REQUIRE(
      runProgram({"simulate", kSmallScene, "--cache", own.string(), "--frames", "1:2", "--quiet"}).exitCode ==
      0);
  CHECK_THAT(pairs(own, {}), !Catch::Contains("motion    "));
}
