// Motions whose answer is known in closed form, and how fast the error of the time stepping falls with the step.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scenes/geometry/box_contacts.h"
#include "scenes/geometry/sphere_contacts.h"
#include "scenes/scenes.h"

namespace scenes {
namespace {

constexpr double pi = 3.14159265358979323846;

mlcp_settings tight() {
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.tolerance = 1e-12;
  return settings;
}

/// error(h) ~ hᵖ: the order p between h and h/4.
double order(const std::function<double(double)>& error, double h) { return std::log2(error(h) / error(h / 4)) / 2; }

/// A block on an inclined plane through the origin, in an upright plane of motion.
class Block : public RigidScene {
 public:
  Block(double slope, double friction, double speed)
      : RigidScene(Motion::Upright, {solid(box, 1, at_rest(slope))}), slope_(slope), friction_(friction) {
    use(FrictionLaw{MLCP_FRICTION_COULOMB, 0});
    use(tight());
    set_velocity(0, rate_along(speed * downhill(), {0, 0, 0}));
  }
  double gone() const { return dot(downhill(), frame(0).origin - at_rest(slope_).origin); }
  double speed() const { return dot(downhill(), velocity_of(0)); }
  void draw(Drawing&) const override {}

 protected:
  void add_rows(RowList&) const override {}
  void add_contacts(ContactList& contacts) const override {
    for (const ContactPoint& at : scenes::contacts(Plane{plane().axis(2)}, {}, box, frame(0), 0.01))
      if (at.feature / 2 % 2 == 0) add_contact(contacts, MLCP_WORLD, 0, at, {.friction = friction_});
  }

 private:
  static constexpr Box box = {{0.2, 0.2, 0.05}};
  static Frame tilted(double slope) { return {{0, 0, 0}, Rotation::about(axes[1], slope)}; }
  static Frame at_rest(double slope) { return tilted(slope) * Frame{{0, 0, box.half_extent[2]}}; }
  Frame plane() const { return tilted(slope_); }
  Point downhill() const { return plane().axis(0); }
  double slope_, friction_;
};

double run(Scene& scene, double h, double seconds) {
  double worst = 0;
  for (int step = 0; step < std::lround(seconds / h); ++step) {
    const mlcp_report& report = scene.step(h);
    EXPECT_EQ(report.outcome, MLCP_SOLVED) << "step " << step;
    worst = std::max(worst, report.largest_error);
  }
  return worst;
}

TEST(ClosedForm, a_block_on_a_slope_rests_just_below_the_critical_angle_and_slides_just_above) {
  const double mu = 0.5, critical = std::atan(mu);
  Block rests(critical - 1e-6, mu, 0), slides(critical + 1e-3, mu, 0);
  run(rests, 0.01, 0.5);
  run(slides, 0.01, 0.5);
  EXPECT_LE(std::fabs(rests.gone()), 1e-10);
  const double a = gravity * (std::sin(critical + 1e-3) - mu * std::cos(critical + 1e-3));
  EXPECT_NEAR(slides.speed(), a * 0.5, 1e-9);
}

TEST(ClosedForm, a_sliding_block_stops_after_v2_over_2_mu_g_at_first_order_in_h) {
  const double mu = 0.3, v = 2;
  const auto error = [&](double h) {
    Block block(0, mu, v);
    run(block, h, 1);
    EXPECT_LE(std::fabs(block.speed()), 1e-10);
    return std::fabs(block.gone() - v * v / (2 * mu * gravity));
  };
  EXPECT_NEAR(order(error, 0.02), 1, 0.25);
}

/// Discs in an upright plane of motion, each on the one below or in a groove of two walls.
class Discs : public RigidScene {
 public:
  Discs(std::vector<Plane> walls, std::vector<Point> centres) : RigidScene(Motion::Upright, discs(centres)), walls_(std::move(walls)) {
    use(tight());
  }
  void draw(Drawing&) const override {}
  /// Normal forces after a step, N: the lowest disc's on each wall, then between each disc and the one above.
  std::vector<double> forces(double h) {
    EXPECT_EQ(step(h).outcome, MLCP_SOLVED);
    const double* gamma = nullptr;
    std::int32_t count = 0;
    check(mlcp_solver_impulses(solver(), &gamma, &count));
    std::vector<double> normal;
    for (std::int32_t i = 0; i < count; ++i) normal.push_back(gamma[i] / h);
    return normal;
  }
  static constexpr Sphere disc = {0.1};
  static constexpr double mass = 2;  // kg

 protected:
  void add_rows(RowList& rows) const override {
    for (const Plane& wall : walls_) add_contact(rows, MLCP_WORLD, 0, contact(wall, {}, disc, frame(0).origin));
    for (std::int32_t i = 1; i < std::ssize(bodies()); ++i) add_contact(rows, i - 1, i, contact(disc, frame(i - 1).origin, disc, frame(i).origin));
  }

 private:
  static std::vector<RigidBody> discs(const std::vector<Point>& centres) {
    std::vector<RigidBody> made;
    for (const Point& centre : centres) made.push_back(solid(disc, mass, {centre, {}}));
    return made;
  }
  std::vector<Plane> walls_;
};

TEST(ClosedForm, a_disc_in_a_groove_leans_on_each_wall_as_the_triangle_of_forces_says) {
  const double left = 0.5, right = 0.9;  // rad from the ground
  const std::vector<Plane> walls = {{{std::sin(left), 0, std::cos(left)}}, {{-std::sin(right), 0, std::cos(right)}}};
  // where both walls touch: n · c = radius for each
  const double det = std::sin(left) * std::cos(right) + std::sin(right) * std::cos(left), r = Discs::disc.radius;
  Discs scene(walls, {{r * (std::cos(right) - std::cos(left)) / det, 0, r * (std::sin(left) + std::sin(right)) / det}});
  const std::vector<double> forces = scene.forces(0.01);
  const double weight = Discs::mass * gravity;
  ASSERT_EQ(forces.size(), 2u);
  EXPECT_NEAR(forces[0], weight * std::sin(right) / std::sin(left + right), 1e-10 * weight);
  EXPECT_NEAR(forces[1], weight * std::sin(left) / std::sin(left + right), 1e-10 * weight);
}

TEST(ClosedForm, each_disc_of_a_stack_carries_those_above) {
  std::vector<Point> centres;
  for (int i = 0; i < 8; ++i) centres.push_back({0, 0, Discs::disc.radius * (2 * i + 1)});
  Discs scene({Plane{}}, centres);
  const std::vector<double> forces = scene.forces(0.01);
  ASSERT_EQ(forces.size(), centres.size());
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const double above = Discs::mass * gravity * static_cast<double>(forces.size() - i);
    EXPECT_NEAR(forces[i], above, 1e-10 * above) << i;
  }
}

TEST(ClosedForm, legs_of_a_table_share_a_load_in_the_middle_equally) {
  Table table;
  mlcp_settings settings;
  mlcp_settings_init(&settings, sizeof settings);
  settings.impulses = MLCP_IMPULSES_LEAST_NORM;
  table.use(settings);
  table.use(FrictionLaw{MLCP_FRICTION_NONE, 0});
  run(table, 0.01, 0.01);
  const double* gamma = nullptr;
  std::int32_t count = 0;
  check(mlcp_solver_impulses(table.solver(), &gamma, &count));
  const double share = 0.01 * gravity * (Table::table_mass + Table::load_mass) / Table::legs;
  for (std::int32_t i = 0; i < Table::legs; ++i) EXPECT_NEAR(gamma[3 * i], share, 1e-9 * share) << "leg " << i;
}

TEST(ClosedForm, legs_of_a_table_carry_the_moments_of_a_load_to_one_side) {
  Table table(0.2, 0.1);
  table.use(tight());
  table.use(FrictionLaw{MLCP_FRICTION_COULOMB, 0});
  run(table, 0.01, 0.05);
  const double* gamma = nullptr;
  std::int32_t count = 0;
  check(mlcp_solver_impulses(table.solver(), &gamma, &count));
  double sum = 0, right = 0;
  for (std::int32_t i = 0; i < Table::legs; ++i) {
    sum += gamma[3 * i];
    right += i % 2 == 0 ? -gamma[3 * i] : gamma[3 * i];
  }
  const double weight = 0.01 * gravity * (Table::table_mass + Table::load_mass);
  EXPECT_NEAR(sum, weight, 1e-9 * weight);
  EXPECT_NEAR(0.45 * right, 0.01 * gravity * Table::load_mass * 0.2, 1e-4 * weight);  // legs stand at ±0.45 m; the ball rolls a little
}

/// A rod that hangs from a pin at its end, with the angle from the vertical.
class Pendulum : public RigidScene {
 public:
  explicit Pendulum(double angle) : RigidScene(Motion::Upright, {solid(rod, 1, hanging(angle))}), pin_(joint(MLCP_WORLD, 0, {})) {
    use(tight());
  }
  double angle() const { return std::atan2(-frame(0).origin[0], -frame(0).origin[2]); }
  static constexpr Box rod = {{0.01, 0.01, 0.5}};
  void draw(Drawing&) const override {}

 protected:
  void add_rows(RowList& rows) const override { add_pin(rows, pin_); }

 private:
  static Frame hanging(double angle) {
    const Rotation turned = Rotation::about(axes[1], angle);
    return {turned * Point{0, 0, -rod.half_extent[2]}, turned};
  }
  Joint pin_;
};

TEST(ClosedForm, a_small_swing_of_a_pendulum_has_its_period_at_first_order_in_h_or_better) {
  const double arm = 0.5, inertia = (0.02 * 0.02 + 1) / 12 + arm * arm, period = 2 * pi * std::sqrt(inertia / (gravity * arm));
  const auto error = [&](double h) {
    Pendulum pendulum(0.01);
    double before = pendulum.angle(), first = -1;
    for (double t = 0; t < 3 * period; t += h) {
      EXPECT_EQ(pendulum.step(h).outcome, MLCP_SOLVED);
      const double now = pendulum.angle();
      if (before > 0 && now <= 0) {
        const double crossed = t + h * before / (before - now);
        if (first >= 0) return std::fabs(crossed - first - period);
        first = crossed;
      }
      before = now;
    }
    ADD_FAILURE() << "it does not swing";
    return 1.0;
  };
  EXPECT_LE(error(0.005), 0.02 * period);
  EXPECT_GE(order(error, 0.01), 0.9);
}

constexpr Sphere bouncing = {0.05};

/// A ball above the ground that bounces on it.
class Ball : public RigidScene {
 public:
  Ball(double height, double restitution)
      : RigidScene(Motion::Upright, {solid(bouncing, 1, {{0, 0, bouncing.radius + height}})}), restitution_(restitution) {}
  double height() const { return frame(0).origin[2] - bouncing.radius; }
  double rises() const { return velocity_of(0)[2]; }
  void draw(Drawing&) const override {}

 protected:
  void add_rows(RowList&) const override {}
  void add_contacts(ContactList& contacts) const override {
    add_contact(contacts, MLCP_WORLD, 0, contact(Plane{}, {}, bouncing, frame(0).origin), {.restitution = restitution_});
  }

 private:
  double restitution_;
};

TEST(ClosedForm, a_ball_bounces_to_e2_of_its_height_and_then_to_e4_at_first_order_in_h) {
  const double height = 1, e = 0.7;
  const auto error = [&](double h) {
    Ball ball(height, e);
    double worst = 0, before = 0;
    for (int bounces = 0, step = 0; bounces < 2 && step < std::lround(3 / h); ++step) {
      EXPECT_EQ(ball.step(h).outcome, MLCP_SOLVED);
      EXPECT_GE(ball.height(), -1e-12);
      if (before > 0 && ball.rises() <= 0) worst = std::max(worst, std::fabs(ball.height() - height * std::pow(e, 2 * ++bounces)));
      before = ball.rises();
    }
    return worst;
  };
  EXPECT_LE(error(1e-3), 0.02 * height);
  EXPECT_GT(error(1e-2), 0);
  EXPECT_LE(error(1e-4), 0.3 * error(1e-3));
}

/// Balls in a row on a table without friction, the first one on its way to the others.
class Cradle : public RigidScene {
 public:
  Cradle(std::int32_t balls, double apart, double restitution, double speed)
      : RigidScene(Motion::Flat, row(balls, apart)), restitution_(restitution) {
    use(tight());
    set_velocity(0, rate_along(speed * axes[0], {0, 0, 0}));
  }
  double speed(std::int32_t ball) const { return velocity_of(ball)[0]; }
  void draw(Drawing&) const override {}

 protected:
  void add_rows(RowList&) const override {}
  void add_contacts(ContactList& contacts) const override {
    for (std::int32_t i = 1; i < std::ssize(bodies()); ++i)
      add_contact(contacts, i - 1, i, contact(bouncing, frame(i - 1).origin, bouncing, frame(i).origin), {.restitution = restitution_});
  }

 private:
  static std::vector<RigidBody> row(std::int32_t balls, double apart) {
    std::vector<RigidBody> made;
    for (std::int32_t i = 0; i < balls; ++i) made.push_back(solid(bouncing, 1, {{i * (2 * bouncing.radius + apart), 0, 0}}));
    return made;
  }
  double restitution_;
};

TEST(ClosedForm, two_balls_part_with_e_times_the_speed_at_which_they_met) {
  const double v = 2;
  for (const double e : {0.0, 0.5, 1.0}) {
    Cradle cradle(2, 0.1, e, v);
    run(cradle, 0.01, 0.2);
    EXPECT_NEAR(cradle.speed(0), (1 - e) / 2 * v, 1e-12) << e;
    EXPECT_NEAR(cradle.speed(1), (1 + e) / 2 * v, 1e-12) << e;
  }
}

TEST(ClosedForm, a_cradle_passes_the_blow_on_where_its_balls_do_not_touch) {
  const double v = 2;
  Cradle cradle(4, 0.05, 1, v);
  run(cradle, 0.01, 0.2);
  for (const std::int32_t ball : {0, 1, 2}) EXPECT_NEAR(cradle.speed(ball), 0, 1e-12);
  EXPECT_NEAR(cradle.speed(3), v, 1e-12);
}

TEST(ClosedForm, touching_balls_share_the_blow_and_keep_momentum_and_energy) {
  const double v = 2;
  Cradle cradle(3, 0, 1, v);
  run(cradle, 0.01, 0.01);
  EXPECT_NEAR(cradle.speed(0), -v / 3, 1e-12);
  EXPECT_NEAR(cradle.speed(1), 2 * v / 3, 1e-12);
  EXPECT_NEAR(cradle.speed(2), 2 * v / 3, 1e-12);
}

TEST(ClosedForm, a_slider_crank_is_where_its_crank_puts_it) {
  const auto error = [](double h) {
    Linkage linkage;
    linkage.use(tight());
    double worst = 0;
    for (int step = 0; step < std::lround(1 / h); ++step) {
      EXPECT_EQ(linkage.step(h).outcome, MLCP_SOLVED);
      const double a = linkage.angle(), height = Linkage::crank * std::sin(a);
      worst = std::max(worst, std::fabs(linkage.slider() - Linkage::crank * std::cos(a) - std::sqrt(Linkage::rod * Linkage::rod - height * height)));
    }
    return worst;
  };
  EXPECT_LE(error(0.0025), 1e-3);
  EXPECT_GE(order(error, 0.01), 0.9);
}

TEST(ClosedForm, stops_keep_a_slider_whose_motor_pushes_it_against_them) {
  Linkage linkage(0.05);
  linkage.use(tight());
  run(linkage, 0.005, 1);
  EXPECT_LE(linkage.violation().penetration, 2e-3);
}

TEST(ClosedForm, a_rope_over_pegs_rests_below_eulers_ratio_and_runs_above) {
  const auto sinks = [](double heavy) {
    RopeOverPegs rope(60, heavy, 0.2);
    rope.use(FrictionLaw{MLCP_FRICTION_COULOMB, 0});
    const double before = rope.heavy_end();
    run(rope, 0.005, 0.5);
    return before - rope.heavy_end();
  };
  const double ratio = std::exp(0.2 * pi);  // a quarter turn on either peg; the rope's own weight brings both sides nearer to each other
  EXPECT_LE(sinks(0.7 * ratio), 0.02);
  EXPECT_GE(sinks(3 * ratio), 0.05);
}

}  // namespace
}  // namespace scenes
