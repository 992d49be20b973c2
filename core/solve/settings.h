#pragma once
#include "mlcp.h"

namespace mlcp {

using Settings = mlcp_settings;
Settings default_settings();
/// fails: Error naming the field.
void check_settings(const Settings& settings);

}  // namespace mlcp
