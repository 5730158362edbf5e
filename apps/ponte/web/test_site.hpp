#pragma once

#include "web/router.hpp"

#include <string>
#include <vector>

namespace ponte::app::testing {

/// Writes down what it is asked to do.
class RecordedActions final : public WebActions {
 public:
  std::string metrics() override { return "metrics\n"; }
  vsm::view::SharedText status() override { return shared_text(R"({"kind":"status"})"); }
  std::string ports() override { return "[]"; }
  HttpResponse connect(const std::string& endpoint) override {
    done.push_back("connect " + endpoint);
    return {.status = 201, .body = shared_text("{}")};
  }
  bool disconnect(std::uint32_t link) override {
    done.push_back("disconnect " + std::to_string(link));
    return link == 1;
  }
  void convert(bool on) override { done.emplace_back(on ? "convert" : "do not convert"); }
  bool start_study(std::uint64_t samples, double limit_ms) override {
    done.push_back("study " + std::to_string(samples) + " " + std::to_string(static_cast<int>(limit_ms)));
    return samples != 99;
  }
  void stop_study() override { done.emplace_back("stop"); }
  std::optional<std::string> study_result(std::string_view format) override {
    return has_study ? std::optional{std::string{format}} : std::nullopt;
  }

  std::vector<std::string> done;
  bool has_study{};
};

}  // namespace ponte::app::testing
