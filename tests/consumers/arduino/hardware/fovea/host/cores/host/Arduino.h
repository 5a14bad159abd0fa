// SPDX-License-Identifier: MIT
//
// What sketches see first: a serial line that is standard output, and macros of the kind that cores have, by
// names that are common in C++.
#pragma once

#include <stdint.h>
#include <stdio.h>

unsigned makeWord(unsigned value);
#define word(...) makeWord(__VA_ARGS__)
#define bit(number) (1ul << (number))
#define abs(value) ((value) > 0 ? (value) : -(value))
#define round(value) ((long)((value) + 0.5))
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define sq(value) ((value) * (value))
#define constrain(value, low, high) ((value) < (low) ? (low) : (value) > (high) ? (high) : (value))
#define radians(degrees) ((degrees) * 0.0174532925)
#define degrees(radians) ((radians) * 57.2957795)
#define PI 3.14159265
#define DEFAULT 1
#define HIGH 1
#define LOW 0
#define INPUT 0
#define OUTPUT 1

typedef uint8_t byte;
typedef bool boolean;

struct SerialLine {
    void begin(long) {}
    void print(const char* text) { fputs(text, stdout); }
    void println(const char* text) { puts(text); }
    void println(int number) { printf("%d\n", number); }
};
extern SerialLine Serial;

void delay(unsigned long milliseconds);
void setup();
void loop();
