#pragma once
#include "analyze/analysis.h"
#include "../../capi/handles.h"
#include "scenes/scenes.h"
#include "solve/basis.h"

namespace bench {

/// A scene's problem solved once, its basis rebuilt on the final active set: what the factor's costs are measured on.
struct SolvedBasis {
  scenes::Problem owner;
  mlcp::Memory memory;
  mlcp::Settings settings = mlcp::default_settings();
  mlcp::Analysis analysis{memory};
  mlcp::Basis basis{memory};
  mlcp::Counts counts;

  /// solve false: every row that the scene has is active, or as many as are independent.
  SolvedBasis(scenes::Problem problem, bool solve);
  const mlcp::Island& largest() const;
  /// Largest |x − x_fresh| / |x_fresh| between a solve with this factor and one factored afresh.
  double drift(const mlcp::Island& island);
};

}  // namespace bench
