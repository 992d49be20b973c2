#pragma once
#include "mlcp.h"

namespace mlcp {

using Settings = mlcp_settings;
Settings default_settings();
/// fails: Error naming the field.
void check_settings(const Settings& settings);
/// Slacks up to this, relative to the scale of their error, count as zero while solving.
double zero_slack(const Settings& settings);

}  // namespace mlcp
