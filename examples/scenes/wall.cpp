#include "wall.h"

#include <algorithm>
#include <utility>

namespace scenes {
namespace {

constexpr double half_brick = 0.125;  // m
constexpr double half_depth = 0.0625;
constexpr double half_height = 0.03125;
constexpr double density = 1800;  // kg/m³

/// Where a brick begins and ends along its course.
struct Span {
  double from, to;
  double middle() const { return 0.5 * (from + to); }
};

std::vector<Span> course(int width, int level) {
  const double brick = 2 * half_brick;
  std::vector<Span> spans;
  if (level % 2 == 0) {
    for (int i = 0; i < width; ++i) spans.push_back({i * brick, (i + 1) * brick});
    return spans;
  }
  spans.push_back({0, half_brick});
  for (int i = 0; i + 1 < width; ++i) spans.push_back({half_brick + i * brick, half_brick + (i + 1) * brick});
  spans.push_back({width * brick - half_brick, width * brick});
  return spans;
}

Brick brick_at(const Span& span, int level) {
  const double half = 0.5 * (span.to - span.from);
  const double mass = density * 8 * half * half_depth * half_height;
  return {{{half, half_depth, half_height}}, {span.middle(), 0, (2 * level + 1) * half_height}, mass};
}

/// The face that both share, seen from the upper brick's centre.
Support support_of(std::int32_t lower, std::int32_t upper, const Span& below, const Span& above) {
  const double from = std::max(below.from, above.from) - above.middle(), to = std::min(below.to, above.to) - above.middle();
  return {lower, upper,
          {{{from, -half_depth, -half_height}, {to, -half_depth, -half_height}, {from, half_depth, -half_height},
            {to, half_depth, -half_height}}}};
}

}  // namespace

BoxStack wall_scene(int width, int height) {
  std::vector<Brick> bricks;
  std::vector<Support> supports;
  std::vector<Span> below;
  std::int32_t first_below = 0;
  for (int level = 0; level < height; ++level) {
    const std::vector<Span> spans = course(width, level);
    const auto first = static_cast<std::int32_t>(bricks.size());
    for (std::size_t i = 0; i < spans.size(); ++i) {
      const std::int32_t upper = first + static_cast<std::int32_t>(i);
      bricks.push_back(brick_at(spans[i], level));
      if (level == 0) supports.push_back(support_of(MLCP_WORLD, upper, spans[i], spans[i]));
      for (std::size_t j = 0; j < below.size(); ++j) {
        if (below[j].from >= spans[i].to || below[j].to <= spans[i].from) continue;
        supports.push_back(support_of(first_below + static_cast<std::int32_t>(j), upper, below[j], spans[i]));
      }
    }
    below = spans;
    first_below = first;
  }
  return BoxStack(bricks, std::move(supports));
}

Problem wall(int width, int height) { return Scene::problem_of_step(wall_scene(width, height)); }

}  // namespace scenes
