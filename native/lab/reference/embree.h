// Embree 3 and 4: in 4 what is asked stands apart from the context that callbacks are handed. VT_EMBREE: 3
// or 4.
#pragma once

#include <stdbool.h>

#if VT_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

/// For scenes in which the filter of a query decides which hits count.
#if VT_EMBREE >= 4
#define VT_SCENE_FILTERED RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS
#else
#define VT_SCENE_FILTERED RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION
#endif

/// How rays are asked for. Callbacks are handed a pointer to its first member.
typedef struct vtRayQuery {
#if VT_EMBREE >= 4
    struct RTCRayQueryContext context;
    struct RTCIntersectArguments arguments;
#else
    struct RTCIntersectContext context;
#endif
} vtRayQuery;

/// `coherent`: the rays of a packet go similar ways, and are faster together. `filter`: it decides which hits
/// count, in a scene with VT_SCENE_FILTERED; NULL: all do.
static inline vtRayQuery vtMakeRayQuery(bool coherent, RTCFilterFunctionN filter)
{
    vtRayQuery query;
#if VT_EMBREE >= 4
    rtcInitRayQueryContext(&query.context);
    rtcInitIntersectArguments(&query.arguments);
    query.arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    if (filter != NULL) {
        query.arguments.flags |= RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
        query.arguments.filter = filter;
    }
#else
    rtcInitIntersectContext(&query.context);
    query.context.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    query.context.filter = filter;
#endif
    return query;
}

static inline void vtIntersect1(RTCScene scene, vtRayQuery* query, struct RTCRayHit* ray)
{
#if VT_EMBREE >= 4
    query->arguments.context = &query->context;
    rtcIntersect1(scene, ray, &query->arguments);
#else
    rtcIntersect1(scene, &query->context, ray);
#endif
}

/// `valid`: -1 for each ray that is asked for, else 0; aligned to 32 bytes.
static inline void vtIntersect8(const int* valid, RTCScene scene, vtRayQuery* query, struct RTCRayHit8* rays)
{
#if VT_EMBREE >= 4
    query->arguments.context = &query->context;
    rtcIntersect8(valid, scene, rays, &query->arguments);
#else
    rtcIntersect8(valid, scene, &query->context, rays);
#endif
}
