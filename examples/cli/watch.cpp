#include "watch.h"

#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace cli {
namespace {

volatile std::sig_atomic_t stop_asked = 0;

void ask_stop(int signal) {
  stop_asked = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Watch::Watch(mlcp_settings& settings) : terminal_(isatty(STDERR_FILENO) == 1) {
  settings.progress = &Watch::progress;
  settings.progress_context = this;
  stop_asked = 0;
  std::signal(SIGINT, ask_stop);
}

std::int32_t Watch::progress(void* self, const mlcp_progress* state) {
  auto& watch = *static_cast<Watch*>(self);
  constexpr double interval = 0.1;  // s between prints
  if (watch.terminal_ && state->seconds >= watch.last_printed_ + interval) {
    std::fprintf(stderr, "\r%.1f s  island %d of %d  %lld pivots  violation %.1e ", state->seconds, state->island + 1,
                 state->islands, static_cast<long long>(state->pivots), state->violation);
    watch.last_printed_ = state->seconds;
  }
  return stop_asked;
}

void Watch::done() {
  if (!watching_) return;
  watching_ = false;
  std::signal(SIGINT, SIG_DFL);
  if (last_printed_ > 0) std::fprintf(stderr, "\r\033[K");
}

}  // namespace cli
