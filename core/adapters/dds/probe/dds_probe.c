// Another process on the bus, for tests: listens and prints what arrived, or says what a script tells it to.
//
//   dds_probe listen DOMAIN SECONDS [COUNT]   prints "ready", then one line a message, until COUNT messages came in
//   all
//                                             or nothing came for SECONDS: after the first, which it awaits a
//                                             minute
//   dds_probe raw DOMAIN SECONDS              prints the bytes of the first command of the hand, in hexadecimal
//   dds_probe talk DOMAIN SCRIPT              one action a line; prints "said" at the end:
//     hand|wrist SEC NANOSEC POINTS NAME=VALUE ...    a JointTrajectory of that many equal points
//     short SEC NANOSEC NAME=VALUE ...                one of the hand whose point lacks its last position
//     pose SEC NANOSEC FRAME X Y Z QX QY QZ QW        a PoseStamped
//     again COUNT MICROSECONDS                        the last one, that often, each stamp a nanosecond later
//     huge names|points COUNT BYTES                   so many for the hand, with a name of that length, or points
//     that
//                                                     take that much
//     sleep MILLISECONDS
//     state states|measured NAME=VALUE ...            a JointState without a stamp
//     wait TOPIC                                      until somebody listens to hand, wrist, pose, states or
//     measured,
//                                                     and half a second more, for the listener knows the sender a
//                                                     little later
//
// Topics are glovebench's own, or with DDS_PROBE_TOPICS=controller in the environment those of a robot's
// controllers.
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <adapters/dds/ros_messages.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef trajectory_msgs_msg_dds__JointTrajectory_ Trajectory;
typedef geometry_msgs_msg_dds__PoseStamped_ Pose;
typedef sensor_msgs_msg_dds__JointState_ State;

enum { kHand, kWrist, kPose, kStates, kMeasured, kTopics, kListened = kMeasured };
static const char* const own_names[kTopics] = {"rt/glovebench/hand/command", "rt/glovebench/wrist/command",
                                               "rt/glovebench/arm/command/pose", "rt/glovebench/joint_states",
                                               "rt/glovebench/measured_joint_states"};
static const char* const controller_names[kTopics] = {
    "rt/rh_trajectory_controller/command", "rt/rh_wr_trajectory_controller/command", "rt/pa10/command/pose",
    "rt/joint_states", "rt/glovebench/measured_joint_states"};
static const char* const short_names[kTopics] = {"hand", "wrist", "pose", "states", "measured"};

// Not exit(): OpenSSL's exit handlers would run while the middleware's threads still encrypt.
static _Noreturn void leave(void) {
  fflush(stdout);
  _Exit(1);
}

static dds_entity_t checked(dds_entity_t result, const char* what) {
  if (result >= 0) return result;
  fprintf(stderr, "dds_probe: %s: %s\n", what, dds_strretcode(-result));
  leave();
}

static dds_entity_t try_topic(dds_entity_t participant, int topic) {
  const dds_topic_descriptor_t* type = topic == kPose     ? &geometry_msgs_msg_dds__PoseStamped__desc
                                       : topic >= kStates ? &sensor_msgs_msg_dds__JointState__desc
                                                          : &trajectory_msgs_msg_dds__JointTrajectory__desc;
  const char* which = getenv("DDS_PROBE_TOPICS");
  const char* name = which && strcmp(which, "controller") == 0 ? controller_names[topic] : own_names[topic];
  return dds_create_topic(participant, type, name, NULL, NULL);
}

static dds_entity_t make_topic(dds_entity_t participant, int topic) {
  return checked(try_topic(participant, topic), short_names[topic]);
}

static dds_qos_t* make_qos(int depth) {
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
  dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
  return qos;
}

static void print_header(const char* topic, const std_msgs_msg_dds__Header_* header, int64_t source_ns) {
  printf("%s %lld %d.%09u \"%s\"", topic, (long long)source_ns, header->stamp.sec, header->stamp.nanosec,
         header->frame_id);
}

static void print_trajectory(const char* topic, const Trajectory* message, int64_t source_ns) {
  print_header(topic, &message->header, source_ns);
  for (uint32_t p = 0; p < message->points._length; ++p) {
    const trajectory_msgs_msg_dds__JointTrajectoryPoint_* point = &message->points._buffer[p];
    printf(" point %d.%09u", point->time_from_start.sec, point->time_from_start.nanosec);
    for (uint32_t j = 0; j < point->positions._length && j < message->joint_names._length; ++j)
      printf(" %s=%.17g", message->joint_names._buffer[j], point->positions._buffer[j]);
  }
  printf(" received %lld\n", (long long)dds_time());
}

static void print_pose(const Pose* message, int64_t source_ns) {
  const geometry_msgs_msg_dds__Point_* p = &message->pose.position;
  const geometry_msgs_msg_dds__Quaternion_* q = &message->pose.orientation;
  print_header("pose", &message->header, source_ns);
  printf(" %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", p->x, p->y, p->z, q->x, q->y, q->z, q->w);
}

static void print_state(const State* message, int64_t source_ns) {
  print_header("states", &message->header, source_ns);
  for (uint32_t j = 0; j < message->name._length && j < message->position._length; ++j)
    printf(" %s=%.17g", message->name._buffer[j], message->position._buffer[j]);
  printf("\n");
}

// Prints what a reader has; returns how much that was.
static int print_all(dds_entity_t reader, int topic) {
  int count = 0;
  for (;;) {
    void* sample = NULL;
    dds_sample_info_t info;
    if (dds_take(reader, &sample, &info, 1, 1) <= 0) return count;
    if (info.valid_data) {
      if (topic == kPose) print_pose(sample, info.source_timestamp);
      if (topic == kStates) print_state(sample, info.source_timestamp);
      if (topic == kHand || topic == kWrist) print_trajectory(short_names[topic], sample, info.source_timestamp);
      ++count;
    }
    dds_return_loan(reader, &sample, 1);
  }
}

static int listen_to_all(dds_entity_t participant, double seconds, int wanted) {
  dds_entity_t readers[kListened];
  dds_qos_t* qos = make_qos(1000);
  for (int t = 0; t < kListened; ++t)
    readers[t] = checked(dds_create_reader(participant, make_topic(participant, t), qos, NULL), "reader");
  dds_delete_qos(qos);
  printf("ready\n");
  fflush(stdout);
  int count = 0;
  const dds_time_t begin = dds_time();
  dds_time_t last = begin;
  while ((wanted == 0 || count < wanted) &&
         (count == 0 ? dds_time() - begin < DDS_SECS(60) : dds_time() - last < (dds_time_t)(seconds * 1e9))) {
    int came = 0;
    for (int t = 0; t < kListened; ++t) came += print_all(readers[t], t);
    count += came;
    if (came > 0) last = dds_time();
    fflush(stdout);
    dds_sleepfor(DDS_MSECS(1));
  }
  return 0;
}

static int print_bytes(dds_entity_t participant, double seconds) {
  dds_qos_t* qos = make_qos(10);
  const dds_entity_t reader =
      checked(dds_create_reader(participant, make_topic(participant, kHand), qos, NULL), "");
  dds_delete_qos(qos);
  printf("ready\n");
  fflush(stdout);
  const dds_time_t end = dds_time() + (dds_time_t)(seconds * 1e9);
  while (dds_time() < end) {
    struct ddsi_serdata* data = NULL;
    dds_sample_info_t info;
    if (dds_takecdr(reader, &data, 1, &info, DDS_ANY_STATE) != 1) {
      dds_sleepfor(DDS_MSECS(1));
      continue;
    }
    const uint32_t size = ddsi_serdata_size(data);
    unsigned char* bytes = malloc(size);
    ddsi_serdata_to_ser(data, 0, size, bytes);
    for (uint32_t i = 0; i < size; ++i) printf("%02x", bytes[i]);
    printf("\n");
    free(bytes);
    ddsi_serdata_unref(data);
    return 0;
  }
  return 1;
}

// What was said last, to be said again.
enum { kMaxNames = 2000 };
static char names_text[64000];
static char* names[kMaxNames];
static double values[kMaxNames];
static trajectory_msgs_msg_dds__JointTrajectoryPoint_ points[8];
static Trajectory trajectory;
static Pose pose;
static State state;
static char frame[256];
static int last_topic = -1;

// Returns how many there are.
static uint32_t read_values(char* text) {
  uint32_t count = 0;
  char* rest = names_text;
  for (char* word = strtok(text, " \n"); word && count < kMaxNames; word = strtok(NULL, " \n")) {
    char* equals = strchr(word, '=');
    *equals = '\0';
    names[count] = strcpy(rest, word);
    rest += strlen(word) + 1;
    values[count++] = strtod(equals + 1, NULL);
  }
  return count;
}

static void read_trajectory(char* text, int point_count, uint32_t missing) {
  const uint32_t count = read_values(text);
  memset(points, 0, sizeof points);
  for (int p = 0; p < point_count; ++p) {
    points[p].positions._maximum = points[p].positions._length = count - missing;
    points[p].positions._buffer = values;
    points[p].time_from_start.nanosec = 20000000;
  }
  trajectory.header.frame_id = "";
  trajectory.joint_names._maximum = trajectory.joint_names._length = count;
  trajectory.joint_names._buffer = names;
  trajectory.points._maximum = trajectory.points._length = (uint32_t)point_count;
  trajectory.points._buffer = points;
}

static void read_state(char* text) {
  memset(&state, 0, sizeof state);
  state.header.frame_id = "";
  state.name._maximum = state.name._length = state.position._maximum = state.position._length = read_values(text);
  state.name._buffer = names;
  state.position._buffer = values;
}

// Those that this process may not make at its start fail when they are used.
static dds_entity_t writer_of(dds_entity_t* writers, int topic) {
  if (writers[topic] > 0) return writers[topic];
  dds_qos_t* qos = make_qos(10);
  writers[topic] = try_topic(writers[kTopics], topic);
  if (writers[topic] > 0) writers[topic] = dds_create_writer(writers[kTopics], writers[topic], qos, NULL);
  dds_delete_qos(qos);
  return writers[topic];
}

static void say(dds_entity_t* writers) {
  const void* message = last_topic == kPose     ? (const void*)&pose
                        : last_topic >= kStates ? (const void*)&state
                                                : (const void*)&trajectory;
  checked(dds_write(checked(writer_of(writers, last_topic), "writer"), message), "write");
}

static void say_again(dds_entity_t* writers, int count, int microseconds) {
  for (int i = 0; i < count; ++i) {
    ++trajectory.header.stamp.nanosec;
    ++pose.header.stamp.nanosec;
    say(writers);
    if (microseconds > 0) dds_sleepfor(DDS_USECS(microseconds));
  }
}

static void say_huge(dds_entity_t* writers, const char* what, int count, size_t bytes) {
  const int of_names = strcmp(what, "names") == 0;
  char* text = of_names ? malloc(bytes + 1) : NULL;
  const uint32_t size = of_names ? 0 : (uint32_t)(bytes / 24);  // four empty sequences and a duration
  if (of_names) {
    memset(text, 'x', bytes);
    text[bytes] = '\0';
  }
  memset(&trajectory, 0, sizeof trajectory);
  trajectory.header.frame_id = "";
  trajectory.joint_names._maximum = trajectory.joint_names._length = of_names ? 1 : 0;
  trajectory.joint_names._buffer = &text;
  trajectory.points._maximum = trajectory.points._length = size;
  trajectory.points._buffer = calloc(size + 1, sizeof *trajectory.points._buffer);
  last_topic = kHand;
  say_again(writers, count, 0);
  free(trajectory.points._buffer);
  free(text);
}

static void await_listener(dds_entity_t* writers, const char* topic) {
  for (int t = 0; t < kTopics; ++t) {
    if (strcmp(topic, short_names[t]) != 0) continue;
    dds_publication_matched_status_t status;
    while (dds_get_publication_matched_status(checked(writer_of(writers, t), "writer"), &status) == 0 &&
           status.current_count == 0)
      dds_sleepfor(DDS_MSECS(1));
    dds_sleepfor(DDS_MSECS(500));
  }
}

static void act(dds_entity_t* writers, char* line) {
  int a = 0, b = 0, from = 0;
  unsigned nanosec = 0;
  char word[16] = "";
  sscanf(line, "%15s", word);
  if (sscanf(line, "again %d %d", &a, &b) == 2) return say_again(writers, a, b);
  if (sscanf(line, "sleep %d", &a) == 1) return dds_sleepfor(DDS_MSECS(a));
  if (sscanf(line, "wait %15s", word) == 1) return await_listener(writers, word);
  if (sscanf(line, "huge %15s %d %d", word, &a, &b) == 3) return say_huge(writers, word, a, (size_t)b);
  if (sscanf(line, "state %15s %n", word, &from) == 1 && from > 0) {
    last_topic = strcmp(word, short_names[kMeasured]) == 0 ? kMeasured : kStates;
    read_state(line + from);
    return say(writers);
  }
  if (sscanf(line, "pose %d %u %255s %lf %lf %lf %lf %lf %lf %lf", &pose.header.stamp.sec,
             &pose.header.stamp.nanosec, frame, &pose.pose.position.x, &pose.pose.position.y, &pose.pose.position.z,
             &pose.pose.orientation.x, &pose.pose.orientation.y, &pose.pose.orientation.z,
             &pose.pose.orientation.w) == 10) {
    pose.header.frame_id = frame;
    last_topic = kPose;
  } else if (sscanf(line, "short %d %u %n", &a, &nanosec, &from) == 2) {
    read_trajectory(line + from, 1, 1);
    last_topic = kHand;
  } else if (sscanf(line, "%15s %d %u %d %n", word, &a, &nanosec, &b, &from) == 4 && b >= 0 && b <= 8) {
    last_topic = strcmp(word, "wrist") == 0 ? kWrist : kHand;
    read_trajectory(line + from, b, 0);
  } else {
    fprintf(stderr, "dds_probe: no action: %s", line);
    leave();
  }
  if (last_topic != kPose) {
    trajectory.header.stamp.sec = a;
    trajectory.header.stamp.nanosec = nanosec;
  }
  say(writers);
}

static int talk(dds_entity_t participant, const char* script) {
  dds_entity_t writers[kTopics + 1] = {0};
  writers[kTopics] = participant;
  FILE* file = fopen(script, "r");
  if (!file) return 1;
  static char line[64000];
  while (fgets(line, sizeof line, file)) act(writers, line);
  fclose(file);
  for (int t = 0; t < kTopics; ++t)
    if (writers[t] > 0) dds_wait_for_acks(writers[t], DDS_SECS(2));
  printf("said\n");
  return 0;
}

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  const dds_entity_t participant =
      checked(dds_create_participant((dds_domainid_t)atoi(argv[2]), NULL, NULL), "participant");
  int result = 2;
  if (strcmp(argv[1], "listen") == 0)
    result = listen_to_all(participant, atof(argv[3]), argc > 4 ? atoi(argv[4]) : 0);
  if (strcmp(argv[1], "raw") == 0) result = print_bytes(participant, atof(argv[3]));
  if (strcmp(argv[1], "talk") == 0) result = talk(participant, argv[3]);
  dds_delete(participant);
  return result;
}
