#include "apps/rays/column_output.h"

#include <numeric>

#include "fathom/failures/errors.h"

namespace fathom::app {

ColumnOutput::ColumnOutput(const std::string& name) : name_(name) {
  if (name.ends_with(".npz")) {
    archive_.emplace(name);
  } else if (name == "-" || name.ends_with(".csv")) {
    text_.emplace(name);
  } else {
    throw UsageError("-o: '" + name + "' does not end in .csv or .npz");
  }
}

void ColumnOutput::finish(const std::vector<Column>& columns) {
  if (text_) return text_->finish(csv_of(columns));
  archive_->write(npz_of(columns, name_));
  archive_->commit();
}

std::vector<std::uint64_t> numbers_up_to(std::size_t count) {
  std::vector<std::uint64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::uint64_t{0});
  return numbers;
}

}  // namespace fathom::app
