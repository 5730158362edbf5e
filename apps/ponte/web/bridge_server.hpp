#pragma once

#include "ponte/transport/loop.hpp"
#include "ponte/vsm/view/bridge_view.hpp"
#include "vsm/live_vsm.hpp"
#include "vsm/vsm_watcher.hpp"
#include "web/access.hpp"
#include "web/http_server.hpp"
#include "web/live_study.hpp"
#include "web/router.hpp"
#include "web/static_files.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace ponte::app {

struct BridgeServerOptions {
  HttpServerOptions http{};
  Tokens tokens{};                   ///< without any, one is made up unless the address is of the loopback interface
  std::filesystem::path web_root{};  ///< of the built page; empty: where `find_web_root` finds it
  std::string profile_name{"default"};
};

/// The bridge page of a live VSM: shows what crosses it, and does what people with the role `command` ask for.
class BridgeServer final : private VsmWatcher, private WebActions, private HttpSite {
 public:
  /// Serves while the loop runs. Throws `Failure`. The loop and the VSM outlive it.
  BridgeServer(transport::Loop& loop, LiveVsm& vsm, BridgeServerOptions options, Log log);
  ~BridgeServer() override;

  /// Where the page is, with the token if one was made up.
  [[nodiscard]] std::string url() const;

 private:
  void on_crossing(const vsm::Crossing& crossing) override;
  void on_clock(Timestamp now, std::span<const vsm::OutgoingMessage> messages) override;
  void on_skipped(vsm::VehicleLinkId link, Bytes run, mavlink::SkipReason reason) override;
  void on_refused(std::string_view reason, std::size_t bytes) override;
  void on_link(const vsm::view::VehicleLink& link) override;
  void on_fact(vsm::VehicleLinkId link, const autopilot::FleetFact& fact) override;
  void on_conversion(bool on) override;

  std::string metrics() override;
  vsm::view::SharedText status() override;
  std::string ports() override;
  HttpResponse connect(const std::string& endpoint) override;
  bool disconnect(std::uint32_t link) override;
  void convert(bool on) override;
  bool start_study(std::uint64_t samples, double limit_ms) override;
  void stop_study() override;
  std::optional<std::string> study_result(std::string_view format) override;

  HttpResponse handle(Timestamp now, const HttpRequest& request) override;
  Result<std::unique_ptr<vsm::view::ClientFeed>, HttpResponse> admit(const HttpRequest& request) override;

  void on_tick(Timestamp now);
  void look_at_vsm() { view_.set_situation(vsm_.situation()); }

  bool has_made_token_;
  BridgeServerOptions options_;
  transport::Loop& loop_;
  LiveVsm& vsm_;
  Log log_;
  vsm::view::BridgeView view_;
  LiveStudy study_;
  Access access_;
  StaticFiles files_;
  Router router_;
  HttpServer http_;
  transport::Timer timer_;
};

}  // namespace ponte::app
