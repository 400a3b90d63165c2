#include <detent/query.h>
#include <stdlib.h>

#include <new>

#include "fields.h"
#include "session.h"

namespace detent_web {
namespace {

void give(Giver& out, QueryHit& hit) {
  visit(out, hit.body);
  out.flag(hit.undecided);
  out.put(fraction_to_host(hit.fraction));
  out.real(hit.distance);
  visit_position(out, hit.point);
  visit_units(out, hit.normal);
  out.word(hit.triangle);
  out.word(hit.material);
}

/// Takes the fields of a query's shape and its pose.
template <class Query>
void take_shape(Taker& in, Query& query) {
  visit(in, query.shape);
  visit_position(in, query.position);
  visit(in, query.rotation);
}

enum class Kind : uint32_t { ray = 1, cast, overlap, bounds, closest };  // as in docs/recording.md

/// `ask`: one of the functions of query.h. Every query ends with its filter and whether it asks for all hits.
template <class Query, class Call>
Status ask(Session& session, Taker& in, Query& query, QueryHits hits, QueryReport& report, Call call) {
  visit(in, query.filter);
  in.flag(query.all);
  return in.status != Status::ok ? in.status : (session.recorder->*call)(query, hits, report);
}

Status answer(Session& session, Taker& in, Kind kind, QueryHits hits, QueryReport& report) {
  if (kind == Kind::ray) {
    RayQuery query;
    visit_position(in, query.origin);
    visit_reals(in, query.displacement);
    return ask(session, in, query, hits, report, &Recorder::query_ray);
  }
  if (kind == Kind::cast) {
    CastQuery query;
    take_shape(in, query);
    visit_reals(in, query.displacement);
    visit_reals(in, query.rotation_vector);
    return ask(session, in, query, hits, report, &Recorder::query_cast);
  }
  if (kind == Kind::overlap) {
    OverlapQuery query;
    take_shape(in, query);
    return ask(session, in, query, hits, report, &Recorder::query_overlap);
  }
  if (kind == Kind::bounds) {
    BoundsQuery query;
    visit_position(in, query.lower);
    visit_position(in, query.upper);
    return ask(session, in, query, hits, report, &Recorder::query_bounds);
  }
  ClosestQuery query;
  take_shape(in, query);
  in.real(query.distance_max);
  return ask(session, in, query, hits, report, &Recorder::query_closest);
}

}  // namespace

/// Asks a query whose fields are `count` doubles on the desk. Gives the number of hits, the number of dropped hits, the
/// number of undecided hits, then the hits.
DETENT_WEB(world_query) uint32_t world_query(Session* session, uint32_t kind, uint32_t count, uint32_t hits_max) {
  Taker in(count);
  QueryHit* hits = hits_max > 1u << 20 ? nullptr : static_cast<QueryHit*>(malloc((hits_max + 1) * sizeof(QueryHit)));
  if (hits == nullptr) return static_cast<uint32_t>(Status::buffer_too_small);
  for (uint32_t i = 0; i < hits_max; ++i) new (hits + i) QueryHit;
  QueryReport report;
  const Status status = answer(*session, in, static_cast<Kind>(kind), {hits, hits_max}, report);
  if (status == Status::ok) {
    Giver out;
    out.word(report.hits);
    out.word(report.dropped);
    out.word(report.undecided);
    for (uint32_t i = 0; i < report.hits; ++i) give(out, hits[i]);
  }
  free(hits);
  return static_cast<uint32_t>(status);
}

}  // namespace detent_web
