#include "tools/report/serve.h"

#include "render/frame_name.h"
#include "tools/base/errors.h"
#include "tools/formats/read_ply.h"
#include "tools/report/figures.h"
#include "tools/report/packed_mesh.h"
#include "tools/report/page.h"
#include "tools/report/write_report.h"
#include "tools/run_folder/finished_run.h"

#include <fmt/core.h>
#include <httplib.h>

#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

constexpr const char* kHost = "127.0.0.1";
constexpr int kNotFound = 404, kForbidden = 403, kFailedToAnswer = 500;
constexpr std::size_t kWholeMesh = std::numeric_limits<std::size_t>::max();

// The run as it is now. Before its first frame is done there is no run.json.
std::string runNow(const fs::path& out) {
  if (!fs::exists(out / "run.json")) {
    Json figures = figuresOf(Json::object(), {});
    figures["title"] = fs::canonical(out).filename().string();
    figures["pictures"] = figures["meshes"] = Json::array();
    figures["video"] = nullptr;
    return scriptSafe(figures);
  }
  ShownRun shown = shownRun({out, out});
  shown.figures["pictures"] = shown.pictures;
  shown.figures["meshes"] = shown.surfaces;
  shown.figures["video"] = shown.video.empty() ? Json(nullptr)
                                               : Json{{"name", shown.video.filename().string()},
                                                      {"bytes", fs::file_size(shown.video)}};
  return scriptSafe(shown.figures);
}

void sendFile(const fs::path& file, const char* type, httplib::Response& response) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    response.status = kNotFound;
    return;
  }
  response.set_content(std::string{std::istreambuf_iterator<char>(in), {}}, type);
}

// The number that a route of digits matched.
int frameIn(const httplib::Request& request) {
  const std::string digits = request.matches[1];
  int frame = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), frame);
  return frame;
}

bool isThisMachine(const std::string& host) {
  const std::string name = host.substr(0, host.find(':'));
  return name == kHost || name == "localhost";
}

void addRoutes(httplib::Server& server, const fs::path& out) {
  server.Get("/", [](const httplib::Request&, httplib::Response& response) {
    response.set_content(servedPage(), "text/html; charset=utf-8");
  });
  server.Get("/run", [out](const httplib::Request&, httplib::Response& response) {
    response.set_content(runNow(out), "application/json");
  });
  // A number of digits alone leads to no file outside.
  server.Get(
      R"(/frames/(\d{1,9})\.png)", [out](const httplib::Request& request, httplib::Response& response) {
        sendFile(out / "frames" / (render::frameName(frameIn(request)) + ".png"), "image/png", response);
      });
  server.Get(R"(/mesh/(\d{1,9}))", [out](const httplib::Request& request, httplib::Response& response) {
    const fs::path file = out / "surface" / (render::frameName(frameIn(request)) + ".ply");
    if (!fs::exists(file)) {
      response.status = kNotFound;
      return;
    }
    response.set_content(packMesh(readPly(file, 1, 1), kWholeMesh), "application/octet-stream");
  });
  server.Get("/video", [out](const httplib::Request&, httplib::Response& response) {
    sendFile(shownRun({out, out}).video, "video/mp4", response);
  });
}

}  // namespace

void serveRun(const fs::path& out, int port, const std::function<void(int)>& ready) {
  existing(out);
  httplib::Server server;
  server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    if (isThisMachine(request.get_header_value("Host"))) return httplib::Server::HandlerResponse::Unhandled;
    response.status = kForbidden;
    return httplib::Server::HandlerResponse::Handled;
  });
  server.set_default_headers({{"Cache-Control", "no-cache"}, {"X-Content-Type-Options", "nosniff"}});
  server.set_exception_handler(
      [](const httplib::Request&, httplib::Response& response, const std::exception_ptr& fault) {
        response.status = kFailedToAnswer;
        try {
          std::rethrow_exception(fault);
        } catch (const std::exception& error) {
          response.set_content(error.what(), "text/plain; charset=utf-8");
        } catch (...) {
        }
      });
  addRoutes(server, out);
  // Else two programs could listen on one port.
  server.set_socket_options([](socket_t) {});
  const int bound = port == 0 ? server.bind_to_any_port(kHost) : server.bind_to_port(kHost, port) ? port : -1;
  if (bound < 0)
    throw UsageError(
        fmt::format("--port {}: cannot be listened on, perhaps since another program does; without --port "
                    "one that is free is taken",
                    port));
  ready(bound);
  server.listen_after_bind();
}

}  // namespace fluidtex::tools
