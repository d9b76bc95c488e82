/** Everything that the window can do by name or key, in the order in which the palette and the page of keys list it. */

import { CONTENTS } from "../logic/page/help";
import { toggleBreakpointHere } from "../store/debug/debugKeys";
import { chooseMode, restart, restartByKey, rollBack, singleScan, toggleRun } from "../store/debug/run";
import { runToCaret, step } from "../store/debug/stepping";
import { showSweeps } from "../store/errors/sweeps";
import { askNewPanel } from "../store/operator/panels";
import { openRack } from "../store/operator/rack";
import { showHelp } from "../store/page/help";
import { openPage, PANELS, showPanel } from "../store/page/navigate";
import { COMMANDS, type Command, SYMBOLS, showKeys, showPalette } from "../store/page/palette";
import {
  chooseLanguage,
  chooseTheme,
  themes,
  toggleChecks,
  toggleFormatOnType,
  toggleInline,
  toggleLenses,
} from "../store/page/prefs";
import { openTour } from "../store/page/tour";
import { showInstances } from "../store/plc/instances";
import { usePlc } from "../store/plc/plc";
import { returnToLive, saveScenarioNow, stepBack } from "../store/plc/timeline";
import { openBreadcrumbs } from "../store/project/breadcrumbs";
import { askBuildMessage } from "../store/project/buildMessage";
import { showUnused } from "../store/project/cross";
import { build, save, useDocuments } from "../store/project/documents";
import { goBack, goForward } from "../store/project/places";
import { goToProblem } from "../store/project/problemKeys";
import { askSearch } from "../store/project/search";
import { showsRan } from "../store/project/shownProgram";
import { openVersions } from "../store/project/versions";
import { showCampaigns } from "../store/verify/campaigns";
import { showWhatIf } from "../store/verify/whatif";
import { languageNames, languages, type TextKey, t } from "../text";
import { helpHere } from "./helpHere";
import { cyclePanes } from "./panes";

interface WindowCommand {
  label: TextKey;
  /** `a|b`: several; `a b`: one after the other. */
  keys?: string;
  run: () => void;
}

const MODES = ["PROGRAM", "MONITOR", "RUN"] as const;

function saveActive(): void {
  const { active } = useDocuments.getState();
  if (active && !showsRan(active)) void save(active);
}

/** Those with a text of their own, by what they are about. */
export const GROUPS: Record<"file" | "run" | "window", readonly WindowCommand[]> = {
  file: [
    { label: "command.save", keys: "Ctrl+S", run: saveActive },
    { label: "command.build", keys: "Ctrl+Shift+B", run: () => void build() },
    { label: "build.saying", run: () => askBuildMessage(true) },
    { label: "restart.rollback", run: () => void rollBack() },
    { label: "command.goto", keys: "Ctrl+P", run: () => showPalette("") },
    { label: "goto.symbol", keys: "Ctrl+T", run: () => showPalette(SYMBOLS) },
    { label: "command.search", keys: "Ctrl+Shift+F", run: askSearch },
    { label: "command.back", keys: "Alt+ArrowLeft", run: goBack },
    { label: "command.forward", keys: "Alt+ArrowRight", run: goForward },
    { label: "crumbs.open", keys: "Ctrl+Alt+O", run: openBreadcrumbs },
    { label: "command.problem.next", keys: "Alt+F8", run: () => goToProblem(1) },
    { label: "command.problem.before", keys: "Alt+Shift+F8", run: () => goToProblem(-1) },
    { label: "operator.new", run: () => askNewPanel(true) },
    { label: "cross.unused", run: () => void showUnused() },
    { label: "device.open", run: () => openPage("plcerrors") },
    { label: "hardware.open", run: () => openPage("hardware") },
    { label: "rack.open", run: openRack },
    { label: "communication.open", run: () => openPage("communication") },
    { label: "memory.open", run: () => openPage("memory") },
    { label: "versions.open", run: () => void openVersions() },
    { label: "command.inline", run: toggleInline },
    { label: "command.checks", run: toggleChecks },
    { label: "command.lenses", run: toggleLenses },
    { label: "command.formatontype", run: toggleFormatOnType },
  ],
  run: [
    { label: "command.run", keys: "F5", run: toggleRun },
    { label: "command.pause", keys: "Ctrl+Alt+Pause", run: () => void step("pause") },
    { label: "run.scan", keys: "F8", run: singleScan },
    { label: "run.back", keys: "Shift+F8", run: stepBack },
    { label: "scenario.now", run: saveScenarioNow },
    { label: "command.live", keys: "Shift+Escape", run: returnToLive },
    { label: "command.breakpoint", keys: "F9", run: toggleBreakpointHere },
    { label: "debug.over", keys: "F10", run: () => void step("next") },
    { label: "debug.in", keys: "F11", run: () => void step("stepIn") },
    { label: "debug.out", keys: "Shift+F11", run: () => void step("stepOut") },
    { label: "debug.back", keys: "Shift+F10", run: () => void step("stepBack") },
    { label: "command.tocaret", keys: "Ctrl+F10", run: runToCaret },
    { label: "debug.reverse", keys: "Alt+F5", run: () => void step("reverseContinue") },
    { label: "restart.cold", keys: "Ctrl+Shift+F5", run: restartByKey },
    { label: "restart.warm", run: () => void restart("warm") },
    { label: "restart.power", run: () => void restart("power") },
  ],
  window: [
    { label: "help.here", keys: "F1", run: helpHere },
    { label: "tour.open", run: openTour },
    { label: "help.contents", run: () => showHelp(CONTENTS) },
    { label: "command.palette", keys: "Ctrl+Shift+P", run: () => showPalette(COMMANDS) },
    { label: "command.keys", keys: "?|Ctrl+K Ctrl+S", run: () => showKeys(true) },
    { label: "command.pane.next", keys: "F6", run: () => cyclePanes(1) },
    { label: "command.pane.before", keys: "Shift+F6", run: () => cyclePanes(-1) },
    { label: "command.instances", run: () => showInstances(true) },
    { label: "command.sweeps", run: showSweeps },
    { label: "command.campaigns", run: showCampaigns },
    { label: "command.whatif", run: () => showWhatIf(usePlc.getState().state?.scan ?? 0) },
    { label: "command.usererrors", run: () => openPage("usererrors") },
  ],
};

interface Arrangement {
  resetLayout: () => void;
  enlarge: () => void;
  /** Opens the active panel in a window of its own. */
  popOut: () => void;
}

/** All of them, and one for each mode, panel, theme and language. The window alone knows how its panels are arranged. */
export function windowCommands({ resetLayout, enlarge, popOut }: Arrangement): Command[] {
  const own = Object.values(GROUPS)
    .flat()
    .map(({ label, keys, run }) => ({
      label: t(label),
      run,
      ...(keys === undefined ? {} : { keys: shownKeys(keys) }),
    }));
  return [
    ...own,
    ...MODES.map((mode) => ({ label: t("command.mode", { mode }), run: () => void chooseMode(mode) })),
    ...PANELS.map((name) => ({ label: t("command.panel", { panel: t(`panel.${name}`) }), run: () => showPanel(name) })),
    { label: t("layout.enlarge"), run: enlarge },
    { label: t("popout.do"), run: popOut },
    { label: t("layout.reset"), run: resetLayout },
    ...themes.map((name) => ({
      label: t("theme.switch", { theme: t(`theme.${name}`) }),
      run: () => chooseTheme(name),
    })),
    ...languages.map((name) => ({
      label: `${t("language")}: ${languageNames[name]}`,
      run: () => chooseLanguage(name),
    })),
  ];
}

const NAMES: Record<string, string> = { ArrowLeft: "←", ArrowRight: "→", Escape: "Esc" };

/** Keys as they are shown, with short names. */
export const shownKeys = (keys: string) =>
  keys.replaceAll("|", ", ").replace(/ArrowLeft|ArrowRight|Escape/g, (key) => NAMES[key] ?? key);
