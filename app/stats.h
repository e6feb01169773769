// stats.csv and passes.csv: what each step did, in SI units.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/passes.h"
#include "sim/io/csv.h"
#include "sim/measure/diagnostics.h"
#include "sim/measure/energy_budget.h"

namespace curlew {

class StepRecorder : public PassObserver {
 public:
  struct Settings {
    bool full_columns = false;
    std::int64_t hash_passes = 0;  // 0: no passes.csv
    std::optional<std::int64_t> resume_after;
  };
  // Writes into `folder`; the plan's passes name the columns.
  StepRecorder(const std::string& folder, const Plan& plan, const Settings& settings);

  // Fields that a row of full columns reads.
  static FieldSet demand(bool full_columns);

  // Call before and after each step; after() is the pass's own report in between.
  void begin_step(const World& world);
  void after(const Pass& pass, const World& world, double milliseconds) override;
  void end_step(double milliseconds);

  // Writes the row of the state as it is. The state's hash stands in full rows and in the `last` one.
  void write_row(const World& world, bool last);

  // The state as it is was the last one after all: completes its row, or writes it.
  void end_early(const World& world);

  const Diagnostics& diagnostics() const { return diagnostics_; }
  const std::vector<double>& milliseconds() const { return total_ms_; }  // of each pass, over the run
  std::int64_t outside() const { return outside_; }

 private:
  std::vector<std::string> columns(const Plan& plan) const;

  Settings settings_;
  std::vector<const Pass*> passes_;
  std::vector<double> pass_ms_, total_ms_;
  double step_ms_ = 0, divergence_after_models_ = 0;
  EnergyBudget budget_;
  Diagnostics diagnostics_;
  std::int64_t outside_ = 0;
  std::unique_ptr<CsvWriter> stats_, hashes_;
  std::vector<std::string> last_row_;
};

}  // namespace curlew
