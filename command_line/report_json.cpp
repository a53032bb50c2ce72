#include "command_line/report_json.h"

#include <nlohmann/json.hpp>

namespace massprops {
namespace {

using Json = nlohmann::ordered_json;

struct ToJson {
  template <class Plain>
  Json operator()(const Plain& value) const {
    return value;
  }
  Json operator()(const Vec3& value) const { return {value.x(), value.y(), value.z()}; }
  Json operator()(const Mat3& value) const {
    Json rows = Json::array();
    for (int row = 0; row < 3; ++row) rows.push_back((*this)(Vec3(value.row(row))));
    return rows;
  }
};

} // namespace

std::string toJson(const Report& report) {
  Json object = Json::object();
  for (const auto& [key, value] : report.entries) object[key] = std::visit(ToJson{}, value);
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace massprops
