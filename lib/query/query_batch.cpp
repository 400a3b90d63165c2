#include <detent/query.h>

#include "base/team.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

template <class Query>
Status answer_all(const World& world, Status (*answer)(const World&, const Query&, QueryHits, QueryReport&),
                  const Query* queries, uint32_t count, QueryHit* hits, uint32_t hits_each, QueryAnswer* answers) {
  with_team(world.hooks.tasks, count, [&](Team* team) {
    share(team, count, k_queries_shared, [&](uint32_t first, uint32_t last) {
      for (uint32_t i = first; i < last; ++i) {
        const QueryHits room = {hits + uint64_t{i} * hits_each, hits_each};
        answers[i].status = answer(world, queries[i], room, answers[i].report);
      }
    });
  });
  for (uint32_t i = 0; i < count; ++i)
    if (answers[i].status != Status::ok) return answers[i].status;
  return Status::ok;
}

}  // namespace

Status query_batch(const World& world, const RayQuery* queries, uint32_t count, QueryHit* hits, uint32_t hits_each,
                   QueryAnswer* answers) {
  return answer_all(world, query_ray, queries, count, hits, hits_each, answers);
}

Status query_batch(const World& world, const CastQuery* queries, uint32_t count, QueryHit* hits, uint32_t hits_each,
                   QueryAnswer* answers) {
  return answer_all(world, query_cast, queries, count, hits, hits_each, answers);
}

Status query_batch(const World& world, const OverlapQuery* queries, uint32_t count, QueryHit* hits, uint32_t hits_each,
                   QueryAnswer* answers) {
  return answer_all(world, query_overlap, queries, count, hits, hits_each, answers);
}

Status query_batch(const World& world, const BoundsQuery* queries, uint32_t count, QueryHit* hits, uint32_t hits_each,
                   QueryAnswer* answers) {
  return answer_all(world, query_bounds, queries, count, hits, hits_each, answers);
}

Status query_batch(const World& world, const ClosestQuery* queries, uint32_t count, QueryHit* hits, uint32_t hits_each,
                   QueryAnswer* answers) {
  return answer_all(world, query_closest, queries, count, hits, hits_each, answers);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
