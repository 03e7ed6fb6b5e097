#include "bench/peer_qhull.h"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <limits>

namespace clench::bench {

std::optional<QhullAnswer> ask_qhull(const Eigen::MatrixXd& points, const std::string& options) {
  Eigen::MatrixXd copy = points;
  std::string command = options;
  qhT state{};
  FILE* nowhere = std::fopen("/dev/null", "w");
  qh_zero(&state, nowhere);
  qhT* qh = &state;
  std::optional<QhullAnswer> answer;
  if (qh_new_qhull(qh, static_cast<int>(copy.rows()), static_cast<int>(copy.cols()), copy.data(),
                   False, command.data(), nullptr, nowhere) == qh_ERRnone) {
    answer.emplace();
    answer->min_offset = std::numeric_limits<double>::infinity();
    facetT* facet;
    FORALLfacets answer->min_offset = std::min(answer->min_offset, -facet->offset);
    answer->volume = qh->totvol;
  }
  qh_freeqhull(qh, !qh_ALL);
  int pieces = 0, bytes = 0;
  qh_memfreeshort(qh, &pieces, &bytes);
  std::fclose(nowhere);
  return answer;
}

}  // namespace clench::bench
