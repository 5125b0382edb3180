// The numbers of the three-stage Radau IIA method of order 5: E. Hairer, G. Wanner, Solving Ordinary
// Differential Equations II (1996), IV.5 (5.9) for A and c, IV.8 for the error estimate.
#pragma once

#include <array>

namespace chainreel::radau5 {

using Row = std::array<double, 3>;
using Matrix = std::array<Row, 3>;

inline constexpr Row c{0.15505102572168219018, 0.64494897427831780982, 1};
inline constexpr Matrix A{{{0.196815477223660425868, -0.0655354258501983881085, 0.0237709743482201524204},
                           {0.394424314739087276997, 0.292073411665228463021, -0.0415487521259979301982},
                           {0.37640306270046727505, 0.512485826188421613839, 0.111111111111111111111}}};

// T^-1 A^-1 T = diag(gamma, [alpha -beta; beta alpha]): one real and one complex eigenvalue.
inline constexpr double gamma = 3.63783425274449573221;
inline constexpr double alpha = 2.6810828736277521339, beta = 3.05043019924741056943;
inline constexpr Matrix T{{{0.0944387624889752414875, -0.141255295020954208428, -0.0300291941051474244919},
                           {0.250213122965333311377, 0.204129352293799931996, 0.382942112757261937795},
                           {1, 1, 0}}};
inline constexpr Matrix T_inv{{{4.17871859155190472735, 0.327682820761062387083, 0.52337644549944954804},
                               {-4.17871859155190472735, -0.327682820761062387083, 0.47662355450055045196},
                               {-0.502872634945786875951, 2.57192694985560542919, -0.596039204828224924969}}};

// The weights of the error estimate (8.19): -(13 + 7 sqrt 6)/3, (-13 + 7 sqrt 6)/3, -1/3; and its product with A.
inline constexpr Row d{-10.0488093998274155625, 1.38214273316074889579, -0.333333333333333333333};
inline constexpr Row dA{-1.55807820472492238243, 0.891411538058255715765, -0.333333333333333333333};

}  // namespace chainreel::radau5
