#include "apps/textbook/pipeline/stage_cases.h"

#include <algorithm>
#include <iterator>

#include "apps/textbook/pipeline/named_stages.h"
#include "apps/textbook/pipeline/stage_record.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::app {
namespace {

const std::vector<stages::NamedStage>& all_stages() {
  static const std::vector<stages::NamedStage> all = [] {
    std::vector<stages::NamedStage> list = stages::geometry_stages();
    std::ranges::move(stages::fragment_stages(), std::back_inserter(list));
    return list;
  }();
  return all;
}

}  // namespace

const std::vector<StageDescription>& pipeline_stages() {
  static const std::vector<StageDescription> descriptions = [] {
    std::vector<StageDescription> list;
    for (const stages::NamedStage& stage : all_stages()) list.push_back(stage.description);
    return list;
  }();
  return descriptions;
}

cases::Json run_stage(const std::string& name, const cases::Json& record,
                      pipeline::Precision precision) {
  const StandardArithmetic standard;
  stages::expect_known_keys(record);
  for (const stages::NamedStage& stage : all_stages())
    if (stage.description.name == name)
      return (precision == pipeline::Precision::binary32 ? stage.binary32 : stage.binary64)(
          record, precision);
  throw UsageError("there is no stage " + name);
}

}  // namespace fathom::app
