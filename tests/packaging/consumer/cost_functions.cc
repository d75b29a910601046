#include <octupole/cost_functions/smoothness_cost.h>
#include <octupole/harmonics/harmonics.h>

#include <memory>

int main() {
  // The residual of weight 4 is 2 (a - b).
  const octupole::Hexadecapole a = octupole::Hexadecapole::Constant(3);
  const octupole::Hexadecapole b = octupole::Hexadecapole::Constant(1);
  const double* parameters[] = {a.data(), b.data()};
  octupole::Hexadecapole residual;
  const std::unique_ptr<ceres::CostFunction> cost(octupole::SmoothnessCost<4>::Create(4));
  return cost->Evaluate(parameters, residual.data(), nullptr) && residual.isApproxToConstant(4) ? 0 : 1;
}
