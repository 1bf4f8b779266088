#pragma once

namespace nurbeam {

/// A reel at an end of a beam: the part of the beam between that end and the reel is stored on it, and has no
/// elements. Its rider stands at the mouth, where the beam leaves the reel.
struct Reel {
  enum class Feed {
    drum,  ///< stored rope turns with the drum, at the speed at which it leaves
    spool  ///< stored rope rests, and is drawn off over the end of the spool
  };

  bool at_start = true;  ///< at the beam's start, else at its end
  Feed feed = Feed::drum;
  /// iota of a spool: rope that is drawn off at v has the tension iota rho v^2; 1/2 without loss [-].
  double pickup = 1;
  /// Of stored rope: |r_s|, and strain energy per reference length [-], [J/m].
  double stretch = 1, strain_energy = 0;

  /// The derivative of the stored length by the place of the mouth.
  double sense() const { return at_start ? 1 : -1; }
};

}  // namespace nurbeam
