#pragma once
#include "analyze/analysis.h"
#include "mlcp.h"
#include "solve/basis.h"

namespace bench {

/// One factorization and one solve of a known active set, the other rows not even in the pattern: no direct method that has to find
/// the active set can be faster.
class Oracle {
 public:
  Oracle(const mlcp_problem* problem, const mlcp_mask* final_mask);

  void analyze();
  void factorize_and_solve();
  /// Of factorize_and_solve, analyzed before.
  double median_seconds();

 private:
  const mlcp_problem* problem_;
  mlcp::Memory memory_;
  mlcp::Settings settings_ = mlcp::default_settings();
  mlcp::Mask active_{memory_};
  mlcp::Analysis analysis_{memory_};
  mlcp::Basis basis_{memory_};
  mlcp::Counts counts_;
};

}  // namespace bench
