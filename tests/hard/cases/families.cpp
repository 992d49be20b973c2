#include "hard/cases/case.h"

namespace hard {

std::span<const Family> families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> list;
    for (const auto part : {multibody_families, contact_families, friction_families, impossible_families, matrix_families})
      for (Family& family : part()) list.push_back(std::move(family));
    return list;
  }();
  return all;
}

}  // namespace hard
