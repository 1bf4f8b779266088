#pragma once
#include <utility>
#include <vector>

#include "fem/element/rancf_basis.h"
#include "nurbs/arc_length.h"

namespace nurbeam {

/// One RANCF element as the papers write it: Eq. (1) of [S], the subdivision paper.
struct RancfElement {
  NodalCoordinates e;       ///< r_A, r_xA, r_B, r_xB
  Eigen::Vector4d weights;  ///< w_0..w_3, positive
  double l;                 ///< label interval [m]; scales r_x only
};

/// The two parts of an element at u_j, Eqs. (4)-(6) of [S] with l_1 = u_j l and l_2 = (1 - u_j) l.
///
/// The shape is unchanged, and so is r_x everywhere: r_xB of the left part is r_xA of the right one. Throws
/// std::invalid_argument unless 0 < u_j < 1. The matrices are as printed, but positions are taken relative to
/// r_A (rows of positions sum to 1, rows of slopes to 0). Slopes so keep their digits far from the origin.
std::pair<RancfElement, RancfElement> split(const RancfElement& element, double u_j);
/// The n parts of an element at n - 1 increasing parameters in (0, 1), Eq. (3) of [S] with i = 1..n. Throws
/// std::invalid_argument when the parameters are not increasing in (0, 1).
std::vector<RancfElement> subdivide(const RancfElement& element, const std::vector<double>& parameters);

/// An element of unchanged shape with weights lambda c^i w_i over a label interval l', in place of Eq. (8) of
/// [S]:
///
///   r'(t) = r(c t / (1 - t + c t)),   r_xA' = c (l / l') r_xA,   r_xB' = (l / l') r_xB / c.
///
/// Throws std::invalid_argument unless c, lambda and l' are positive.
RancfElement reparametrised(const RancfElement& element, double c, double lambda, double new_l);

/// k_1 = w_0 w_2 / w_1^2 [-], k_2 = w_1 w_3 / w_2^2 [-], k_3 = l^2 r_xA . r_xB [m^2].
///
/// Eq. (8) of [S], where k_3 lacks l^2 and so holds only between elements of one l. Elements have the same
/// k_1 and k_2 exactly when their weights are related as in reparametrised(). The same k_3 is necessary for
/// the same shape, not sufficient: 2 r_xA and r_xB / 2 give it too.
struct ShapeFactors {
  double k1, k2, k3;
};
ShapeFactors shape_factors(const RancfElement& element);

/// Density of parameter points up to arc length x, Eq. (13) of [S] in the limit N_T -> infinity:
///
///   D(x) = (u(x) / x) L_T   [-],   D(L_T) = 1.
///
/// With N_T parameter points spread evenly over [0,1], N(x) of them up to x, Eq. (15) says N(x) = N_T u(x) up
/// to one point, so Eq. (13) differs from this by at most L_T / (x N_T). For x -> 0 D tends to L_T / |r'(0)|
/// = L_T / (l |r_xA|). Eqs. (14) and (16), u / D = x / L_T, hold by this definition. Throws
/// std::invalid_argument unless 0 < x <= L_T.
double parameter_density(const ArcLengthMap& map, double x);

/// Ends +-k of the range of Eq. (18) of [S], both excluded: 2 length / (parts (parts - 1)) [m]; infinite for
/// one part.
double grading_limit(double length, int parts);
/// Places x_1..x_{n-1} [m] that divide a length into n parts, each longer than the one before it by k [m].
///
/// Eq. (17) of [S] in one line: x_j = j length / n - k j (n - j) / 2. Throws std::invalid_argument, naming
/// the range of k, unless Eq. (18) holds; more strictly, the shortest part must be longer than 1e-9 of the
/// mean one.
std::vector<double> graded_places(double length, int parts, double k);
/// Parameters u_1..u_{n-1} of the graded places, Eq. (19) of [S]. Throws as graded_places.
std::vector<double> graded_parameters(const ArcLengthMap& map, int parts, double k);

}  // namespace nurbeam
