// The C headers that mavgen makes, over the corpus: what every user of MAVLink in C does, and nothing more.
//
// usage: peer FOLDER

#include "ardupilotmega/mavlink.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { repetitions = 5, samples_of_a_type = 512, encode_rounds = 200 };

// Makes the compiler believe that the value is used.
#define KEEP(value) __asm__ volatile("" : : "r"(&(value)) : "memory")

static uint64_t fnv(uint64_t hash, const void* bytes, size_t size) {
  const uint8_t* at = bytes;
  for (size_t i = 0; i < size; ++i) hash = (hash ^ at[i]) * 0x100000001B3ULL;
  return hash;
}
#define HASH(field) *hash = fnv(*hash, (const void*)&(field), sizeof(field))

struct Encoding {
  uint64_t frames;
  uint64_t hash;
};

// The messages of one type that the corpus begins with.
#define STORE(name)                                       \
  static mavlink_##name##_t name##_samples[samples_of_a_type]; \
  static size_t name##_count;
#define KEEP_SAMPLE(name)                                     \
  if (name##_count < samples_of_a_type) mavlink_msg_##name##_decode(message, &name##_samples[name##_count++])
#define ENCODE(name)                                                                  \
  for (size_t i = 0; i < name##_count; ++i) {                                         \
    mavlink_message_t message;                                                        \
    uint8_t buffer[MAVLINK_MAX_PACKET_LEN];                                           \
    mavlink_msg_##name##_encode(1, 1, &message, &name##_samples[i]);                  \
    const uint16_t size = mavlink_msg_to_send_buffer(buffer, &message);               \
    KEEP(buffer);                                                                     \
    if (encoding->hash != 0) encoding->hash = fnv(encoding->hash, buffer, size);      \
    ++encoding->frames;                                                               \
  }

#include "peer_messages.h"

static double seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

struct Corpus {
  uint8_t* bytes;
  size_t size;
};

static struct Corpus load(const char* folder, const char* name) {
  char path[4096];
  snprintf(path, sizeof path, "%s/%s.bin", folder, name);
  FILE* file = fopen(path, "rb");
  if (!file) exit((perror(path), 1));
  fseek(file, 0, SEEK_END);
  struct Corpus corpus = {NULL, (size_t)ftell(file)};
  rewind(file);
  corpus.bytes = malloc(corpus.size);
  if (fread(corpus.bytes, 1, corpus.size, file) != corpus.size) exit((perror(path), 1));
  fclose(file);
  return corpus;
}

static mavlink_signing_t signing;
static mavlink_signing_streams_t streams;

static void set_up_signing(int verify) {
  memset(&signing, 0, sizeof signing);
  memset(&streams, 0, sizeof streams);
  for (unsigned i = 0; i < 32; ++i) signing.secret_key[i] = (uint8_t)i;
  signing.link_id = 7;
  mavlink_get_channel_status(MAVLINK_COMM_0)->signing = verify ? &signing : NULL;
  mavlink_get_channel_status(MAVLINK_COMM_0)->signing_streams = verify ? &streams : NULL;
}

// Frames that were found in one pass over the corpus.
static inline uint64_t parse(struct Corpus corpus, int decode, uint64_t* hash) {
  uint64_t frames = 0;
  mavlink_message_t message;
  mavlink_status_t status;
  mavlink_reset_channel_status(MAVLINK_COMM_0);
  for (size_t i = 0; i < corpus.size; ++i) {
    if (!mavlink_parse_char(MAVLINK_COMM_0, corpus.bytes[i], &message, &status)) continue;
    ++frames;
    if (decode) decode_message(&message, hash);
  }
  return frames;
}

static int compare(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

static void print(const char* name, uint64_t frames, uint64_t hash, double* times) {
  qsort(times, repetitions, sizeof *times, compare);
  printf("{\"case\":\"%s\",\"frames\":%llu,\"hash\":\"%016llx\",\"ns\":%.3f}\n", name, (unsigned long long)frames,
         (unsigned long long)hash, times[repetitions / 2] * 1e9 / (double)frames);
}

static void measure_parse(const char* folder, const char* name, int verify, int decode) {
  const struct Corpus corpus = load(folder, name);
  uint64_t hash = 0xCBF29CE484222325ULL, frames = 0;
  double times[repetitions];
  set_up_signing(verify);
  parse(corpus, 1, &hash);
  for (int i = 0; i < repetitions; ++i) {
    set_up_signing(verify);
    const double begin = seconds();
    frames = decode ? parse(corpus, 1, NULL) : parse(corpus, 0, NULL);
    times[i] = seconds() - begin;
  }
  char title[64];
  snprintf(title, sizeof title, "%s %s", verify ? "verify" : decode ? "decode" : "parse", name);
  print(title, frames, hash, times);
  free(corpus.bytes);
}

static void measure_encode(const char* folder) {
  const struct Corpus corpus = load(folder, "v2");
  mavlink_message_t message;
  mavlink_status_t status;
  set_up_signing(0);
  mavlink_reset_channel_status(MAVLINK_COMM_0);
  for (size_t i = 0; i < corpus.size; ++i)
    if (mavlink_parse_char(MAVLINK_COMM_0, corpus.bytes[i], &message, &status)) keep_sample(&message);
  mavlink_get_channel_status(MAVLINK_COMM_0)->current_tx_seq = 0;
  struct Encoding check = {0, 0xCBF29CE484222325ULL};
  encode_all(&check);
  double times[repetitions];
  struct Encoding encoding = {0, 0};
  for (int i = 0; i < repetitions; ++i) {
    encoding.frames = 0;
    const double begin = seconds();
    for (int round = 0; round < encode_rounds; ++round) encode_all(&encoding);
    times[i] = seconds() - begin;
  }
  print("encode", encoding.frames, check.hash, times);
  free(corpus.bytes);
}

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  static const char* const names[] = {"v1", "v2", "v2_signed", "v2_noisy"};
  for (size_t i = 0; i < 4; ++i) measure_parse(argv[1], names[i], 0, 1);
  measure_parse(argv[1], "v2", 0, 0);
  measure_parse(argv[1], "v2_signed", 1, 1);
  measure_encode(argv[1]);
  return 0;
}
