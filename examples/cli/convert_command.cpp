#include "convert_command.h"

#include <iostream>

#include "fclib_file.h"
#include "problem_folder.h"
#include "velocities.h"

namespace cli {

void run_convert(const std::string& from, const std::string& to) {
  // files that name no model: Coulomb's law, so that contacts are kept; a snapshot keeps its own
  const bool snapshot = std::filesystem::is_regular_file(from) && !is_fclib(from);
  const ProblemFile file = read_problem(from, snapshot ? Friction{} : Friction{MLCP_FRICTION_COULOMB, 0});
  const std::size_t left_out = static_cast<std::size_t>(file.file_rows) - file.file_row.size();
  if (left_out > 0) std::cerr << "mlcp: " << left_out << " rows of rolling friction were left out\n";
  if (to.ends_with(".mlcp")) {
    char message[512];
    handles::check(mlcp_snapshot_save(to.c_str(), file.problem.get(), file.solver.get(), file.enabled.get(), file.start.get(),
                                      message, sizeof message),
                   message);
  } else {
    if (file.enabled && mlcp_mask_count(file.enabled.get(), MLCP_ROW_DISABLED) > 0) {
      throw std::runtime_error(to + ": only a snapshot can hold disabled rows");
    }
    if (to.ends_with(".hdf5")) write_fclib(to, file.problem);
    else write_folder(to, file.problem);
    const std::int32_t prescribed = velocities_of(file.problem.get()).prescribed_bodies;
    if (prescribed > 0) std::cerr << "mlcp: " << prescribed << " prescribed bodies went into c and d; v is without them\n";
  }
}

}  // namespace cli
