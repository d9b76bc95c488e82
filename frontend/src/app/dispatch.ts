/** Passes every message of the server to the store that it concerns. The switch is exhaustive: a new message is a compile error. */

import { onCoverage } from "../store/debug/coverage";
import { joinDebugger, onBreakpoints } from "../store/debug/debug";
import { forgetRefusals } from "../store/debug/run";
import { onDevice } from "../store/errors/device";
import { onSweep, onSweepHello } from "../store/errors/sweeps";
import { onFileSaved } from "../store/errors/userErrors";
import { catchUpPanels, onPanelSaved } from "../store/operator/panels";
import { usePrefs } from "../store/page/prefs";
import { onComparison, refreshComparisons } from "../store/past/comparisons";
import { onRerun } from "../store/past/reruns";
import { onProject, useBench } from "../store/plc/bench";
import { setClock } from "../store/plc/clock";
import { followLink } from "../store/plc/links";
import { resetMembers } from "../store/plc/members";
import { onErrors, onHello, onLog, onState, usePlc } from "../store/plc/plc";
import { onTimeline } from "../store/plc/timeline";
import { apply } from "../store/plc/values";
import { onWatching, watchAgain } from "../store/plc/watches";
import { scheduleCheck } from "../store/project/checking";
import { catchUp, onBuilt, onDeleted, onSaved } from "../store/project/documents";
import { onDraft, onDraftEdited } from "../store/project/drafts";
import { onPeople } from "../store/project/people";
import { onRetrospective, onTraces, refreshTraces } from "../store/trace/traces";
import { onCampaign, refreshCampaigns } from "../store/verify/campaigns";
import { onDisturbances } from "../store/verify/disturb";
import { onVerifications, refreshVerifications } from "../store/verify/verify";
import { onForces, onWritten } from "../store/watch/forces";
import { refreshMembers } from "../store/watch/watchlist";
import { catchUpLists, onWatchList } from "../store/watch/watchlists";
import { t } from "../text";
import { dap } from "../wire/dap";
import { sayNoConnection } from "../wire/rest";
import { abandon, settle } from "../wire/send";
import { link } from "../wire/socket";
import type { ServerMessage } from "../wire/types";

export function connectStores(): void {
  followLanguage();
  sayNoConnection((reading) => t(reading ? "lost.read" : "lost.change"));
  link.listen({
    onStatus: (status) => {
      usePlc.setState({ link: status });
      if (status.state === "open") return;
      dap.abandon();
      abandon(""); // also when the page goes to a different PLC: nobody answers any more
    },
    onMessage: dispatch,
    onFrame: (frame) => {
      setClock(frame.scan, frame.timeNs);
      apply(frame);
    },
  });
}

/** Whatever the server has said is said again, in the language that the page has now. */
function followLanguage(): void {
  usePrefs.subscribe((now, before) => {
    if (now.language === before.language) return;
    link.again();
    scheduleCheck();
  });
}

function dispatch(message: ServerMessage): void {
  switch (message.type) {
    case "hello":
      onHello(message);
      onForces(message.forces);
      onDevice(message.device);
      onTimeline(message.timeline);
      onDisturbances(message.disturbances);
      onProject(message.instance.project);
      useBench.setState({ instance: message.instance });
      joinDebugger(message.breakpoints);
      onCoverage(message.coverage);
      watchAgain();
      void catchUpLists();
      onSweepHello();
      void refreshTraces();
      void refreshVerifications();
      void refreshComparisons();
      void refreshCampaigns();
      void catchUp();
      void catchUpPanels();
      followLink();
      return;
    case "state":
      onState(message.state);
      return;
    case "watching":
      onWatching(message.items, message.ref === null);
      return;
    case "done":
      if (message.ok) forgetRefusals();
      settle(message);
      return;
    case "errors":
      onErrors(message.rows, message.whole);
      return;
    case "lines":
      usePlc.setState({ lines: message.broken });
      break;
    case "armed":
      usePlc.setState({ armed: message.faults });
      return;
    case "log":
      onLog(message.lines);
      return;
    case "users":
      usePlc.setState({ users: message.users });
      return;
    case "people":
      onPeople(message);
      return;
    case "built":
      onBuilt(message.result, message.author === usePlc.getState().you?.name ? null : message.author);
      if (message.result.ok) newProgram(message.result.project);
      return;
    case "saved":
      void onSaved(message.file);
      onFileSaved(message.file);
      void onPanelSaved(message.file);
      return;
    case "deleted":
      void onDeleted(message.path, message.author);
      return;
    case "instance_deleted":
      usePlc.setState({ deletedBy: message.author });
      return;
    case "draft":
      onDraft(message);
      return;
    case "draft_edited":
      onDraftEdited(message);
      return;
    case "forces":
      onForces(message.forces, message.ended);
      return;
    case "device":
      onDevice(message.found);
      return;
    case "diagnostics":
      usePlc.setState({ diagnostics: message });
      return;
    case "timeline":
      onTimeline(message);
      return;
    case "written":
      onWritten(message.path, message.author, message.scan);
      return;
    case "sweep":
      onSweep(message);
      return;
    case "watch_list":
      void onWatchList(message);
      return;
    case "dap":
      dap.receive(message.message);
      return;
    case "breakpoints":
      onBreakpoints(message.breakpoints);
      return;
    case "coverage":
      onCoverage(message);
      return;
    case "traces":
      onTraces(message.traces);
      return;
    case "verifications":
      onVerifications(message.verifications);
      return;
    case "retrospective":
      onRetrospective(message);
      return;
    case "disturbances":
      onDisturbances(message.disturbances);
      return;
    case "comparison":
      onComparison(message);
      return;
    case "campaign":
      onCampaign(message);
      return;
    case "rerun":
      onRerun(message);
      return;
    case "alive":
      return;
    default:
      message satisfies never;
  }
}

function newProgram(project: Parameters<typeof onProject>[0]): void {
  onProject(project);
  resetMembers(useBench.getState().instance?.id ?? null);
  void refreshMembers();
}
