#pragma once

/// Runs random strikes on mixed cells until `n` have yielded, and prints how they end. Returns 0
/// where every number is finite.
int study_random_scenes(int n, unsigned seed);
