bool moved(const Constraint& constraint) { return std::get<Support>(constraint).motion.has_value(); }
