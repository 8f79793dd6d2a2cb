// The smallest assignment: for the grader's own tests.
#pragma once

#include <vector>

double twice(double x);
/// Sums of the first number, the first two numbers, ... up to all numbers.
std::vector<double> sums(const std::vector<double>& numbers);
