// Where a step's energy comes from and goes to, in J (per metre of depth in 2D).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/core/passes.h"

namespace curlew {

// Ask it after each pass, and it splits the change of the kinetic energy between the causes, exactly: a pass that
// changes velocities has what it took; a force k, which works only when all forces a are applied together, has
// dt sum m a_k . (v + dt a / 2). Losses count what was taken, works what was given.
// What moving bodies do by pressure, force times their velocity, is their work and no gain of the solves. What no-slip
// ones do by friction stays in the loss by viscosity, and what they do to particles that are put on their surface in
// the loss by advection.
class EnergyBudget {
 public:
  struct Term {
    std::string_view name;  // "work_micropolar", "loss_density_solve"; a string literal
    const Pass* pass;       // whose it is
    bool is_work;
    double step = 0;  // J, of the last step
  };

  explicit EnergyBudget(const Plan& plan);

  const std::vector<Term>& terms() const { return terms_; }

  void begin_step(const World& world);
  void after(const Pass& pass, const World& world);

 private:
  void share_out(const World& world);
  Term* term_of(const Pass& pass);

  std::vector<Term> terms_;
  static constexpr std::size_t no_term = ~std::size_t{0};
  std::size_t spin_ = no_term;    // the term of what the models give to the rotation
  std::size_t bodies_ = no_term;  // and of what moving bodies do
  double body_work_ = 0;          // J, in this step so far
  double kinetic_ = 0, rotational_ = 0;
  Array<Vec3> before_;               // acceleration before the force in hand
  std::vector<Array<Vec3>> forces_;  // acceleration by each term, where it is a force
};

}  // namespace curlew
