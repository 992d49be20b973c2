#pragma once
#include <cstdarg>
#include <cstdio>

#include "mlcp.h"

namespace mlcp {

/// What a call refuses and why. The text names the argument and the index; it needs no allocation.
struct Error {
  mlcp_status status;
  char text[512];

  [[gnu::format(printf, 3, 4)]] Error(mlcp_status s, const char* format, ...) : status(s) {
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
  }
};

}  // namespace mlcp
