#include "cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "scenes/vector.h"

namespace {

using namespace scenes;

constexpr double gravity = 9.81, h = 0.01;
constexpr int world = -1;

int padded(int n) { return n > 1 ? (n + 3) / 4 * 4 : n; }

/// A scene of bodies with isotropic inertia and rows between them, turned into A = J M⁻¹ Jᵀ and b = −J (v + h g).
class Assembly {
 public:
  /// A box or ball of this mass, kg, and size, m; returns its number.
  int body(double mass, double size, Point centre, Point velocity = {0, 0, 0}, Point acceleration = {0, 0, -gravity}) {
    bodies_.push_back({1 / mass, 6 / (mass * size * size), centre, velocity + h * acceleration});
    return static_cast<int>(bodies_.size()) - 1;
  }

  /// Three free rows that keep `point` of both bodies together. All before the first contact.
  void pin(int a, int b, Point point) {
    for (const Point& axis : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}}) row(a, b, point, axis, -INFINITY, INFINITY, -1);
    nub_ += 3;
  }

  /// b rests on a along the normal; mu = 0: one row, else three.
  void contact(int a, int b, Point point, double mu, Point normal = {0, 0, 1}) {
    const int first = static_cast<int>(rows_.size());
    row(a, b, point, normal, 0, INFINITY, -1);
    if (mu == 0) return;
    const Point along = std::abs(normal[0]) < 0.9 ? cross({1, 0, 0}, normal) : cross({0, 1, 0}, normal);
    const Point t1 = (1 / length(along)) * along, t2 = cross(normal, t1);
    for (const Point& t : {t1, t2}) row(a, b, point, t, -mu, mu, first);
  }

  /// The four corners of a box's underside.
  void stand(int a, int b, double size, double mu) {
    const Point centre = bodies_[static_cast<std::size_t>(b)].centre;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) contact(a, b, centre + size * Point{x, y, -0.5}, mu);
  }

  Case finish(std::string name) const {
    const int n = static_cast<int>(rows_.size());
    const auto stride = static_cast<std::size_t>(padded(n));
    Case made{std::move(name), n, nub_, std::vector<double>(static_cast<std::size_t>(n) * stride), {}, {}, {}, {}};
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      double speed = 0;
      for (std::size_t j = 0; j < rows_.size(); ++j) made.A[i * stride + j] = coupling(rows_[i], rows_[j]);
      for (const Side& side : rows_[i].sides)
        if (side.body != world) speed += dot(side.linear, bodies_[static_cast<std::size_t>(side.body)].velocity);
      made.b.push_back(-speed);
      made.lo.push_back(rows_[i].lo);
      made.hi.push_back(rows_[i].hi);
      made.findex.push_back(rows_[i].findex);
    }
    return made;
  }

 private:
  struct Body {
    double inverse_mass, inverse_inertia;
    Point centre, velocity;  // velocity: at the end of the step, were there no contacts
  };
  struct Side {
    int body;
    Point linear, angular;
  };
  struct Row {
    std::array<Side, 2> sides;
    double lo, hi;
    int findex;
  };

  void row(int a, int b, const Point& point, const Point& direction, double lo, double hi, int findex) {
    const auto side = [&](int body, double sign) {
      const Point arm = body == world ? Point{} : point - bodies_[static_cast<std::size_t>(body)].centre;
      return Side{body, sign * direction, sign * cross(arm, direction)};
    };
    rows_.push_back({{side(a, -1), side(b, 1)}, lo, hi, findex});
  }

  double coupling(const Row& one, const Row& other) const {
    double sum = 0;
    for (const Side& p : one.sides)
      for (const Side& q : other.sides) {
        if (p.body == world || p.body != q.body) continue;
        const Body& body = bodies_[static_cast<std::size_t>(p.body)];
        sum += body.inverse_mass * dot(p.linear, q.linear) + body.inverse_inertia * dot(p.angular, q.angular);
      }
    return sum;
  }

  std::vector<Body> bodies_;
  std::vector<Row> rows_;
  int nub_ = 0;
};

Case box_on_floor(const char* name, double mu, Point push) {
  Assembly scene;
  const int box = scene.body(2, 0.2, {0, 0, 0.1}, {0, 0, 0}, push + Point{0, 0, -gravity});
  scene.stand(world, box, 0.2, mu);
  return scene.finish(name);
}

/// Boxes of one metre on each other, the mass growing from `lightest` at the bottom to `heaviest` at the top, pushed sideways.
Case tower(const char* name, int boxes, double lightest, double heaviest, double mu, double push) {
  Assembly scene;
  int below = world;
  for (int i = 0; i < boxes; ++i) {
    const double mass = boxes == 1 ? heaviest : lightest * std::pow(heaviest / lightest, static_cast<double>(i) / (boxes - 1));
    const int box = scene.body(mass, 1, {0, 0, i + 0.5}, {0, 0, 0}, {push * gravity, 0, -gravity});
    scene.stand(below, box, 1, mu);
    below = box;
  }
  return scene.finish(name);
}

/// Balls in layers, each on four of the layer below: a pyramid of cannon balls.
Case cannon_balls(const char* name, int layers, double mu) {
  Assembly scene;
  const double d = 0.2, rise = d * std::sqrt(0.5);
  std::vector<int> below;
  for (int layer = 0; layer < layers; ++layer) {
    const int side = layers - layer;
    std::vector<int> balls;
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y) {
        const Point centre{d * (x + 0.5 * layer), d * (y + 0.5 * layer), 0.5 * d + rise * layer};
        const int ball = scene.body(1, d, centre);
        balls.push_back(ball);
        if (layer == 0) scene.contact(world, ball, centre - Point{0, 0, 0.5 * d}, mu);
        if (layer == 0) continue;
        for (const double sx : {-1.0, 1.0})
          for (const double sy : {-1.0, 1.0}) {
            const Point normal{-0.5 * sx, -0.5 * sy, std::sqrt(0.5)};
            const int lower = below[static_cast<std::size_t>((x + (sx > 0)) * (side + 1) + y + (sy > 0))];
            scene.contact(lower, ball, centre - (0.5 * d) * normal, mu, normal);
          }
      }
    below = balls;
  }
  return scene.finish(name);
}

/// Links that hang from the world, a heavy one at the end that touches a wall.
Case chain(const char* name, int links, double heaviest, double mu) {
  Assembly scene;
  int last = world;
  for (int i = 0; i < links; ++i) {
    const int link = scene.body(i + 1 == links ? heaviest : 1, 0.1, {0, 0, -0.1 * (i + 0.5)}, {-0.1, 0, 0});
    scene.pin(last, link, {0, 0, -0.1 * i});
    last = link;
  }
  scene.contact(world, last, {-0.05, 0, -0.1 * (links - 0.5)}, mu, {1, 0, 0});
  return scene.finish(name);
}

/// A ball between two planes that lean apart, pushed into them.
Case wedge(const char* name, double degrees, double mu) {
  Assembly scene;
  const double a = degrees * std::acos(-1.0) / 180;
  const int ball = scene.body(1, 0.2, {0, 0, 0}, {0, 1, -1});
  for (const double side : {-1.0, 1.0}) {
    const Point normal{side * std::cos(a), 0, std::sin(a)};
    scene.contact(world, ball, -0.1 * normal, mu, normal);
  }
  return scene.finish(name);
}

/// Fathi (1979): pivoting methods by least index take 2ⁿ steps.
Case fathi(const char* name, int n) {
  Case made{name, n, 0, std::vector<double>(static_cast<std::size_t>(n * padded(n))), {}, {}, {}, {}};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) made.A[static_cast<std::size_t>(i * padded(n) + j)] = i == j ? 4 * i + 1 : 4 * std::min(i, j) + 2;
    made.b.push_back(1);
    made.lo.push_back(0);
    made.hi.push_back(INFINITY);
    made.findex.push_back(-1);
  }
  return made;
}

}  // namespace

std::vector<Case> all_cases() {
  return {box_on_floor("box on a floor", 0, {0, 0, 0}),
          box_on_floor("box, friction holds", 0.5, {3, 0, 0}),
          box_on_floor("box, slides", 0.2, {4, 3, 0}),
          cannon_balls("55 cannon balls", 5, 0),
          cannon_balls("14 cannon balls, friction", 3, 0.6),
          tower("tower of 10", 10, 1, 1, 0, 0),
          tower("tower of 10, friction", 10, 1, 1, 0.5, 0),
          tower("tower of 10, pushed", 10, 1, 1, 0.5, 0.1),
          tower("tower of 5, 1 : 1e4", 5, 1, 1e4, 0, 0),
          tower("tower of 5, 1 : 1e4, pushed", 5, 1, 1e4, 0.5, 0.05),
          tower("tower of 5, 1 : 1e8", 5, 1, 1e8, 0, 0),
          chain("chain of 30, 1000 kg at its end", 30, 1e3, 0),
          chain("the same, rough wall", 30, 1e3, 0.5),
          wedge("wedge, mu = 0.3", 30, 0.3),
          wedge("wedge, mu = 2", 30, 2),
          fathi("Fathi's example", 16)};
}
