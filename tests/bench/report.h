#pragma once
#include "tests/bench/judge.h"

/// The rows for people and for programs.
namespace detent_bench {

std::string table_of(const std::vector<Row>& rows);
/// A JSON array, a row a line.
std::string json_of(const std::vector<Row>& rows);

}  // namespace detent_bench
