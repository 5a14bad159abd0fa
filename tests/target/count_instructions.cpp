// SPDX-License-Identifier: MIT
//
// A plugin of QEMU 7.2 (plugin interface 1): how many instructions a guest executes between
// fovea_region_begin() and fovea_region_end(), a line a region. Exact and the same in every run.
//   qemu-system-arm ... -plugin count_instructions.so,out=FILE
// Debian has no header for plugins, so the calls of the interface that are used here are declared here.
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>

extern "C" {
using PluginId = std::uint64_t;
struct TranslationBlock;
struct Instruction;
struct PluginInfo;
void qemu_plugin_register_vcpu_tb_trans_cb(PluginId, void (*)(PluginId, TranslationBlock*));
void qemu_plugin_register_vcpu_insn_exec_cb(Instruction*, void (*)(unsigned, void*), int registers, void*);
void qemu_plugin_register_vcpu_insn_exec_inline(Instruction*, int operation, void*, std::uint64_t);
void qemu_plugin_register_atexit_cb(PluginId, void (*)(PluginId, void*), void*);
std::size_t qemu_plugin_tb_n_insns(const TranslationBlock*);
Instruction* qemu_plugin_tb_get_insn(const TranslationBlock*, std::size_t);
const char* qemu_plugin_insn_symbol(const Instruction*);

[[gnu::visibility("default"), gnu::used]] int qemu_plugin_version = 1;
}

namespace {

constexpr int add_operation = 0;
constexpr int no_registers = 0;

// Plain memory: QEMU asks for the file when destructors have already run.
constexpr int most_regions = 4096;
std::uint64_t executed;
std::uint64_t at_begin;
std::uint64_t regions[most_regions];
int region_count;
char out_path[4096];

void begin_region(unsigned, void*) { at_begin = executed; }
void end_region(unsigned, void*) {
    if (region_count < most_regions) regions[region_count++] = executed - at_begin;
}

void translate(PluginId, TranslationBlock* block) {
    for (std::size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i) {
        Instruction* instruction = qemu_plugin_tb_get_insn(block, i);
        qemu_plugin_register_vcpu_insn_exec_inline(instruction, add_operation, &executed, 1);
        // A function that is called begins a block.
        const char* symbol = i == 0 ? qemu_plugin_insn_symbol(instruction) : nullptr;
        if (symbol == nullptr) continue;
        if (std::strcmp(symbol, "fovea_region_begin") == 0)
            qemu_plugin_register_vcpu_insn_exec_cb(instruction, begin_region, no_registers, nullptr);
        if (std::strcmp(symbol, "fovea_region_end") == 0)
            qemu_plugin_register_vcpu_insn_exec_cb(instruction, end_region, no_registers, nullptr);
    }
}

void write_regions(PluginId, void*) {
    std::FILE* file = std::fopen(out_path, "w");
    if (file == nullptr) return;
    for (int i = 0; i < region_count; ++i) std::fprintf(file, "%" PRIu64 "\n", regions[i]);
    std::fclose(file);
}

}  // namespace

extern "C" [[gnu::visibility("default"), gnu::used]] int qemu_plugin_install(PluginId id, const PluginInfo*,
                                                                             int count, char** arguments) {
    for (int i = 0; i < count; ++i)
        if (std::strncmp(arguments[i], "out=", 4) == 0)
            std::snprintf(out_path, sizeof out_path, "%s", arguments[i] + 4);
    if (out_path[0] == '\0') {
        std::fprintf(stderr, "count_instructions: out=FILE is missing\n");
        return -1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
    qemu_plugin_register_atexit_cb(id, write_regions, nullptr);
    return 0;
}
