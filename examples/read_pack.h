#pragma once
// Reading a pack as any game may: the library itself opens no files.

#include <surefoot/pack_file/pack.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

/// A pack and the bytes that it points into.
struct LoadedPack {
    std::vector<std::byte> bytes;
    surefoot::Pack pack;
};

/// Ends the program with exit code 2 where there is no sound pack.
inline LoadedPack read_pack(const char* file) {
    LoadedPack loaded;
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    loaded.bytes.resize(in ? static_cast<std::size_t>(in.tellg()) : 0);
    in.seekg(0);
    in.read(reinterpret_cast<char*>(loaded.bytes.data()), static_cast<std::streamsize>(loaded.bytes.size()));
    std::string why;
    std::optional<surefoot::Pack> pack = surefoot::Pack::open(loaded.bytes, &why);
    if (!pack) {
        std::fprintf(stderr, "%s: %s\n", file, why.c_str());
        std::exit(2);
    }
    loaded.pack = *std::move(pack);
    return loaded;
}
