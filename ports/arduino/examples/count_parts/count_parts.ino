// SPDX-License-Identifier: MIT
//
// Counts the dark parts of a picture. It is drawn here; a camera would write its rows into picture.view().
#include <fovea.h>

static fovea::ImageStorage<fovea::Gray8, 80, 60> picture;
static std::uint8_t scratch[fovea::connected_components_scratch(80)];
static fovea::List<fovea::Region, 10> regions;
static fovea::List<fovea::Hole, 10> holes;

static fovea::Status count_parts() {
    fovea::Status s = fovea::fill_rectangle(picture.view(), {0, 0, 80, 60}, fovea::Gray8{220});
    if (s == fovea::Status::ok) s = fovea::fill_rectangle(picture.view(), {10, 10, 20, 20}, fovea::Gray8{30});
    if (s == fovea::Status::ok) s = fovea::fill_rectangle(picture.view(), {50, 30, 15, 20}, fovea::Gray8{30});
    if (s == fovea::Status::ok) s = fovea::threshold_inverse(picture.view(), 128, picture.view());
    if (s == fovea::Status::ok)
        s = fovea::connected_components(picture.view(), fovea::ComponentOptions(), scratch, regions, holes);
    return s;
}

void setup() { Serial.begin(115200); }

void loop() {
    const fovea::Status s = count_parts();
    if (s == fovea::Status::ok) {
        Serial.print("parts: ");
        Serial.println(regions.size());
    } else {
        Serial.println(fovea::describe(s));
    }
    delay(1000);
}
