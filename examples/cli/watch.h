#pragma once
#include <cstdint>

#include "mlcp.h"

namespace cli {

/// Watches a solve: a progress line on standard error if that is a terminal, and Ctrl-C stops with the outcome "interrupted". One
/// at a time. A second Ctrl-C ends the program.
class Watch {
 public:
  /// Sets the progress callback. Must live while the settings are in use.
  explicit Watch(mlcp_settings& settings);
  ~Watch() { done(); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Takes the progress line away and gives Ctrl-C back.
  void done();

 private:
  static std::int32_t progress(void* self, const mlcp_progress* state);
  bool terminal_;
  bool watching_ = true;
  double last_printed_ = 0;
};

}  // namespace cli
