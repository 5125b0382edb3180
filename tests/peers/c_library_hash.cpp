// Prints a hash over what the C library's functions return for many arguments. It picks them by the
// processor, and their last bits differ: that is what the emulated processors of same_bits_test must show, or
// they prove nothing.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

int main() {
  std::uint64_t hash = 0;
  const auto add = [&hash](double value) {
    hash = hash * 1099511628211u ^ std::bit_cast<std::uint64_t>(value);
  };
  for (int i = 0; i < 20000; ++i) {
    const double x = 0.37 * i + 0.1;
    add(std::sin(x));
    add(std::exp(1e-3 * x));
    add(std::pow(1 + x, 0.3));
  }
  std::printf("%llx\n", static_cast<unsigned long long>(hash));
}
