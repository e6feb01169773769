// The solver in a program of your own: ten lines and find_package(curlew).
#include <iostream>

#include "sim/core/params.h"

int main() {
  for (const curlew::ParameterRow& row : curlew::parameter_table()) std::cout << row.key << '\n';
  std::cout << curlew::parameter_table().size() << " parameters\n";
  return curlew::parameter_table().empty() ? 1 : 0;
}
