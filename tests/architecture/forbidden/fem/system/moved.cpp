bool moved(const Constraint& constraint) { return std::get<Support>(constraint).motion.has_value(); }

double force(const BeamProperties& beam, double strain) { return beam.axial_stiffness * strain; }
