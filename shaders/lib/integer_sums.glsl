// Sums of a pixel in integers, which add up to the same bits in any order. Layers 0 to 2 hold the
// emission of red, green and blue, layer 3 the sum of -log2(1 - opacity), all in units of 2^-24 modulo
// 2^32; layer 4 counts how often each of them passed 2^32 (a step of 256), 8 bits a channel.
//
// A channel overflows at 2^16. Light from a fragment is at most 3 (ambient, diffuse and specular weights
// are at most 1), which needs more than 21,000 layers; the logarithm is cut at 32, a transmittance below
// half of float's epsilon squared, which needs 2,048 layers of opacity 1.
const float kUnitsPerOne = 16777216.0;
const float kPerCarry = 256.0;
const float kLargestLog = 32.0;
const int kCarryLayer = 4;
const int kLogLayer = 3;
