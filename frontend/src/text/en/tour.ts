/** English: the tour of the sample. */
export const tour = {
  "tour.again": "From the beginning",
  "tour.back": "Shift+F10, or the arrow to the left, goes back to where the block was called.",
  "tour.back.done":
    "The step was taken back, with everything that it changed. Any scan of the run can be gone back to: the timeline below shows them all.",
  "tour.before": "Back",
  "tour.close": "Close the tour",
  "tour.end":
    "That was the tour. A second sample, Dosing (choose it at the top left), shows objects, Instruction List and subranges. F1 explains what has the focus.",
  "tour.go":
    "Click the breakpoint once more to remove it, then press F5 twice: the first time leads to where the PLC halted last, the second lets it run.",
  "tour.go.done": "The program runs on as if nothing had happened: its time stood still meanwhile.",
  "tour.halt": "Click beside line 26 of Main.st, belt(run := motor);, to set a breakpoint.",
  "tour.halt.done":
    "The PLC halts before this line, for everybody. On the left are its call stack and its variables; a click on a value changes it.",
  "tour.history": "Open the panel History.",
  "tour.history.done": "The error is listed as tested: when it came, when it went, and what the program did about it.",
  "tour.into": "F11, or the arrow down, steps into the block.",
  "tour.into.done": "The program is in Belt now. The values beside the lines are those of this instance.",
  "tour.leave": "Leave the tour; it goes on here next time",
  "tour.next": "Next",
  "tour.open": "Tour of the sample",
  "tour.raise": "In the error simulator click Basic I/O Unit error, then press Generate.",
  "tour.raise.done":
    "A402.12 became TRUE, lamp latches, and the belt stops: the program reacted. Below the tree are the statements that read the error.",
  "tour.recover": "Press Recover.",
  "tour.recover.done": "The error is gone from the memory of the PLC. The lamp stays on until reset is TRUE.",
  "tour.sample": "The tour uses the sample Conveyor. Choose it at the top left.",
  "tour.sample.done":
    "This is the sample Conveyor, on an Omron CJ1M: a belt, a counter of parts, a buffer, and a handler of errors.",
  "tour.show": "Show me",
  "tour.skip": "Skip",
  "tour.step": "Step {at} of {of}",
  "tour.sweep": "Press Run all, and start the sweep.",
  "tour.sweep.done":
    "Each error is raised alone, from the same state. The table says what the program does about it; the Inner board error is read without effect, the Battery error never.",
  "tour.title": "Tour",
  "tour.write": "In the watch table click into the column Change of start, type TRUE, and press Enter.",
  "tour.write.done":
    "The write was done between two scans. In the next one the program read start: motor becomes TRUE, unless stop or an error holds the belt.",
};
