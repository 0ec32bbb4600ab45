#pragma once

namespace CLI {
class App;
}

namespace handway::tools {

// Exit codes of the command line (docs/command-line.md).

inline constexpr int kDone = 0;
inline constexpr int kNoPath = 1;      ///< No path within the limits, or a path not valid.
inline constexpr int kNotWritten = 1;  ///< A result that could not be written.
inline constexpr int kWrongUsage = 2;
inline constexpr int kInvalidInput = 3;
inline constexpr int kInvalidQuery = 4;   ///< Start or goal in collision or out of limits.
inline constexpr int kMotionStopped = 5;  ///< A robot's motion did not reach its end.

/// Adds `handway arm` and its command `emulate`.
void add_arm_command(CLI::App& app, int& exit_code);

/// `handway bench [SCENE…]`: times of collision checks and plans.
void add_bench_command(CLI::App& app, int& exit_code);

/// Adds `handway calibrate` and its command `camera`.
void add_calibrate_command(CLI::App& app, int& exit_code);

/// `handway check SCENE PATH.csv`: re-checks a path on the exact meshes.
void add_check_command(CLI::App& app, int& exit_code);

/// `handway cloud FILE`: adds points of a camera to a scene.
void add_cloud_command(CLI::App& app, int& exit_code);

/// Adds `handway compare`.
void add_compare_command(CLI::App& app, int& exit_code);

/// Adds `handway dataset`.
void add_dataset_command(CLI::App& app, int& exit_code);

/// Adds `handway edit` and its commands, one for each kind of edit.
void add_edit_command(CLI::App& app, int& exit_code);

/// `handway export PATH.csv`: times a path and writes it for a controller.
void add_export_command(CLI::App& app, int& exit_code);

/// handway glove emulate|live|record|replay …
void add_glove_command(CLI::App& app, int& exit_code);

/// Adds `handway grasp SCENE OBJECT`.
void add_grasp_command(CLI::App& app, int& exit_code);

/// Adds `handway hand` and its command `emulate`.
void add_hand_command(CLI::App& app, int& exit_code);

/// Adds `handway haptic` and its commands `guide` and `emulate`.
void add_haptic_command(CLI::App& app, int& exit_code);

/// `handway info SCENE|ROBOT`: contents and warnings.
void add_info_command(CLI::App& app, int& exit_code);

/// `handway pca RECORDING…`: finds a hand's principal motion directions.
void add_pca_command(CLI::App& app, int& exit_code);

/// `handway plan SCENE`: finds a path and writes it.
void add_plan_command(CLI::App& app, int& exit_code);

/// `handway problems --out DIR`: generates the open benchmark for hands on arms.
void add_problems_command(CLI::App& app, int& exit_code);

/// Adds `handway recording` and its commands `info` and `convert`.
void add_recording_command(CLI::App& app, int& exit_code);

/// `handway reproduce`: the paper's tables, measured again.
void add_reproduce_command(CLI::App& app, int& exit_code);

/// Adds `handway ros` and its command `emulate`.
void add_ros_command(CLI::App& app, int& exit_code);

/// Adds `handway send PATH.csv --scene SCENE --to DEVICE`.
void add_send_command(CLI::App& app, int& exit_code);

/// `handway setup ROBOT.urdf`: groups, pairs of links that may touch, and suspicious parts.
void add_setup_command(CLI::App& app, int& exit_code);

/// Adds `handway simulate SCENE PATH.csv|PROGRAM`.
void add_simulate_command(CLI::App& app, int& exit_code);

/// Adds `handway task SCENE`.
void add_task_command(CLI::App& app, int& exit_code);

/// `handway time PATH.csv`: duration of a path, and the checks of its motion.
void add_time_command(CLI::App& app, int& exit_code);

/// handway tracker emulate|live …
void add_tracker_command(CLI::App& app, int& exit_code);

}  // namespace handway::tools
