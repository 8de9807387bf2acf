// SPDX-License-Identifier: BSD-3-Clause
// Runs urdfdom and collects its errors instead of printing them.
#include "description/parse_with_urdfdom.hpp"

#include <mutex>

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

namespace hinge::robotics {

namespace {

/// console_bridge requires a derived class.
class Complaints : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    // The first two messages name the fault and the element; later ones repeat them.
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR || ++count_ > 2) return;
    // Cut long messages: the rest is general advice about URDF.
    std::string sentence = text.substr(0, text.find(".  "));
    for (char& c : sentence)
      if (c == '\n') c = ' ';
    text_ += (text_.empty() ? "" : "; ") + sentence;
  }
  const std::string& text() const { return text_; }

 private:
  int count_ = 0;
  std::string text_;
};

}  // namespace

Parsed parse_with_urdfdom(const std::string& text) {
  static std::mutex one_at_a_time;  // the handler is global to the process
  const std::scoped_lock lock(one_at_a_time);
  Complaints complaints;
  const console_bridge::LogLevel level = console_bridge::getLogLevel();
  console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_ERROR);
  console_bridge::useOutputHandler(&complaints);
  Parsed parsed{urdf::parseURDF(text), ""};
  console_bridge::restorePreviousOutputHandler();
  console_bridge::setLogLevel(level);
  parsed.complaint = complaints.text();
  if (!parsed.model && parsed.complaint.empty()) parsed.complaint = "urdfdom refuses the file without a message";
  return parsed;
}

}  // namespace hinge::robotics
