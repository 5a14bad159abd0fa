// SPDX-License-Identifier: MIT
//
// One turn of a sketch.
#include <Arduino.h>

SerialLine Serial;

void delay(unsigned long) {}

int main() {
    setup();
    loop();
    return 0;
}
