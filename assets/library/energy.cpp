// energy MODEL.urdf: lets it fall from zero for 2 s and prints its energy, which friction alone may take.
#include <chainreel/dynamics.hpp>

#include <cstdio>

int main(int count, char** words) try {
  if (count != 2) return std::fprintf(stderr, "usage: energy MODEL.urdf\n"), 2;
  const chainreel::Chain chain = chainreel::read_chain(words[1]);
  chainreel::Workspace ws(chain);
  std::vector<double> q = chainreel::zero_configuration(chain), qd(std::size_t(chain.nv)), tau(qd.size());

  const double h = 1e-5;  // s
  for (int k = 0; k <= 200'000; ++k) {
    if (k % 20'000 == 0) {
      const chainreel::Energy energy = chainreel::energy_of(chain, ws, q, qd);
      std::printf("t = %.1f s  E = %+.4f J  of which %.4f J move\n", k * h, energy.total(), energy.kinetic);
    }
    chainreel::compute_forward_dynamics(chain, ws, q, qd, tau);
    for (std::size_t i = 0; i < qd.size(); ++i) qd[i] += h * ws.qdd[i];
    chainreel::advance(chain, q, qd, h);
  }
} catch (const chainreel::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return int(error.code());
}
