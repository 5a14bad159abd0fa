// SPDX-License-Identifier: MIT
//
// The public types that a program stores, each as a symbol of its size: tests/checks/memory.py reads them
// from the object, for processors whose programs cannot run here too.
#include <fovea/base/list.hpp>
#include <fovea/camera/packed_camera.hpp>
#include <fovea/camera/undistortion_map.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/draw/polygon.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/segment/connected_components.hpp>
#include <fovea/statistics/histogram.hpp>
#include <fovea/stereo/rectify.hpp>
#include <fovea/stereo/triangulate.hpp>

namespace fovea {

template <class T>
char bytes_of[sizeof(T)] = {};

template char bytes_of<ImageView<Gray8>>[];
template char bytes_of<Histogram>[];
template char bytes_of<Moments>[];
template char bytes_of<CentralMoments>[];
template char bytes_of<Region>[];
template char bytes_of<Hole>[];
template char bytes_of<ConnectedComponents>[];
template char bytes_of<Edge>[];
template char bytes_of<PolygonEdge>[];
template char bytes_of<Feature>[];
template char bytes_of<Recipe>[];
template char bytes_of<FeatureResult>[];
template char bytes_of<PartResult>[];
template char bytes_of<UndistortionMap>[];
template char bytes_of<CameraSet>[];
template char bytes_of<StereoCamera<>>[];
template char bytes_of<Rectification<>>[];
template char bytes_of<Triangulator<>>[];

}  // namespace fovea
