// Rooted trees and what a Runge-Kutta tableau makes of them (E. Hairer, S. Norsett, G. Wanner, Solving
// Ordinary Differential Equations I, II.2): a method has order p if and only if
//   sum_i b_i phi_i(tree) = 1 / gamma(tree)   for every tree with at most p nodes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace chainreel {

// A root and the trees that hang on it.
struct Tree {
  std::vector<Tree> branches;
};

inline int nodes_of(const Tree& tree) {
  int nodes = 1;
  for (const Tree& branch : tree.branches) nodes += nodes_of(branch);
  return nodes;
}

inline double gamma_of(const Tree& tree) {
  double gamma = nodes_of(tree);
  for (const Tree& branch : tree.branches) gamma *= gamma_of(branch);
  return gamma;
}

// phi_i = product over the branches of sum_j a_ij phi_j(branch).
template <class Matrix>
std::vector<double> phi_of(const Tree& tree, const Matrix& a) {
  std::vector<double> phi(a.size(), 1.0);
  for (const Tree& branch : tree.branches) {
    const std::vector<double> inner = phi_of(branch, a);
    for (std::size_t i = 0; i < a.size(); ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < a.size(); ++j) sum += a[i][j] * inner[j];
      phi[i] *= sum;
    }
  }
  return phi;
}

// All trees with `nodes` nodes: 1, 1, 2, 4, 9, 20, 48, 115, .. of them.
inline std::vector<Tree> trees_with(int nodes) {
  // The trees of each size in a row; a root takes branches in falling order, so that none comes twice.
  std::vector<std::vector<Tree>> all(std::size_t(nodes) + 1);
  const auto add = [&](const auto& self, Tree& root, int left, int size, std::size_t first,
                       int whole) -> void {
    if (left == 0) {
      all[std::size_t(whole)].push_back(root);
      return;
    }
    for (int n = size; n >= 1; --n) {
      if (n > left) continue;
      for (std::size_t k = n == size ? first : 0; k < all[std::size_t(n)].size(); ++k) {
        root.branches.push_back(all[std::size_t(n)][k]);
        self(self, root, left - n, n, k, whole);
        root.branches.pop_back();
      }
    }
  };
  for (int n = 1; n <= nodes; ++n) {
    Tree root;
    add(add, root, n - 1, n - 1, 0, n);
  }
  return all[std::size_t(nodes)];
}

}  // namespace chainreel
