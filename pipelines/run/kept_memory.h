#pragma once

namespace nurbeam {

/// For the whole process: what is given back to the allocator is kept. Vectors of large models are taken and
/// given back in every step, and whole models with every variant of a study: the kernel would clear the same
/// pages again and again.
void keep_memory();

/// Gives back what is free at the moment.
void give_back_memory();

}  // namespace nurbeam
