// SPDX-License-Identifier: MIT
//
// World: what the daemon is connected to, which a template takes.
//
//   std::int64_t now_us()
//   camera()                      a CameraKeeper
//   const char* camera_fault(), camera_advice(), link_fault()
//                                 of their last trouble
//   std::int64_t frame_interval_us(), std::uint64_t missed_frames()
//                                 of the camera
//   Status gray(const hal::FrameInfo&, ImageView<const Gray8>&)
//                                 the picture of a frame, good until the next
//   ImageVerdict quality(ImageView<const Gray8>)
//                                 whether a picture can be judged at all
//   link()                        a SerialLink, which may have no port
//   lines()                       VerdictLines
//   bool next_edge(TriggerEdge&)  edges of the trigger's line that have not been taken
//   Status trigger_status()       ok as long as these are heard
//   void print(Span<const char>)  a line of JSON, without its end
//   void keep_failure(ImageView<const Gray8>, const Inspection&)
//   bool take_failure_event(FailureRingEvent&)
//   Status keep_sample(Span<const char> name, ImageView<const Gray8>, Fault&)
//   workers()                     who work on a picture, see OneWorker
//   Span<std::uint8_t> scratch()  for judge_scratch() of every job and so many workers
//   const JobList& jobs()
#pragma once

#include <cstdint>

namespace fovea::apps {

/// An edge on the trigger's line.
struct TriggerEdge {
    std::int64_t time_us = 0;
    /// Edges in front of it that the kernel had no room for.
    std::uint32_t lost = 0;
};

}  // namespace fovea::apps
