#pragma once
// Uses std::vector without its header.
std::vector<int> joints();
