import { useEffect, useRef } from "react";
import { loneIn, operatedPanel } from "../logic/plc/links";
import { DebugSide } from "../panels/debug/stack/DebugSide";
import { Sweeping } from "../panels/errors/sweep/Sweeping";
import { BuildMessage } from "../panels/project/change/BuildMessage";
import { OnlineChange } from "../panels/project/change/OnlineChange";
import { Explorer } from "../panels/project/explorer/Explorer";
import { Banners } from "../panels/run/banner/Banners";
import { Past } from "../panels/run/past/Past";
import { Timeline } from "../panels/run/timeline/Timeline";
import { TopBar } from "../panels/run/topbar/TopBar";
import { Instances } from "../panels/shell/instances/Instances";
import { Palette } from "../panels/shell/palette/Palette";
import { StatusBar } from "../panels/shell/status/StatusBar";
import { TraceImport } from "../panels/verify/import/TraceImport";
import { VerifyRecords } from "../panels/verify/records/VerifyRecords";
import { offerCommands } from "../store/page/palette";
import { usePrefs } from "../store/page/prefs";
import { useTour } from "../store/page/tour";
import { start, useBench } from "../store/plc/bench";
import { t } from "../text";
import { Icon } from "../ui/Icon";
import { IconButton } from "../ui/IconButton";
import { later } from "../ui/later";
import { windowCommands } from "./commands";
import { Dock, type DockHandle } from "./Dock";
import { Keys } from "./Keys";
import { installKeys } from "./keys";
import { LoneWindow } from "./LoneWindow";
import { PanelWindow } from "./PanelWindow";
import { Splitter } from "./Splitter";
import { useFlyout } from "./useFlyout";
import { useFrame } from "./useFrame";

const Tour = later(() => import("../panels/tour/Tour"));

/** The window: rail, bars, explorer and the dock. */
export function App() {
  const phase = useBench((bench) => bench.phase);
  // A different language: every text is drawn again.
  const language = usePrefs((prefs) => prefs.language);
  if (phase === "locked" || phase === "failed") return <Shut key={language} locked={phase === "locked"} />;
  const alone = operatedPanel(location);
  if (alone !== null) return <PanelWindow key={language} path={alone} />;
  const lone = loneIn(location);
  if (lone !== null) return <LoneWindow key={language} panel={lone} />;
  return <Window key={language} />;
}

function Window() {
  const dock = useRef<DockHandle>(null);
  const { side, toggle } = useFlyout();
  const { frame } = useFrame(useBench((bench) => bench.instance?.name ?? bench.project?.name));

  useEffect(() => installKeys(), []);
  useEffect(() => {
    const arrangement = {
      resetLayout: () => dock.current?.reset(),
      enlarge: () => dock.current?.enlarge(),
      popOut: () => dock.current?.popOut(),
    };
    return offerCommands(() => windowCommands(arrangement));
  }, []);

  return (
    <div className="app" {...frame}>
      <div className="rail" />
      <TopBar onResetLayout={() => dock.current?.reset()} />
      <div className="bannerslot">
        <Banners />
        <TourWhenOpen />
      </div>
      <main className={`work${side ? ` showleft show-${side}` : ""}`}>
        <div className="strip" role="toolbar" aria-label={t("strip.label")}>
          <IconButton
            icon="folder"
            label={t("explorer.label")}
            className={side === "explorer" ? "is-on" : ""}
            onClick={() => toggle("explorer")}
          />
          <IconButton
            icon="stack"
            label={t("strip.debug")}
            className={side === "debug" ? "is-on" : ""}
            onClick={() => toggle("debug")}
          />
        </div>
        <div className="left leftside">
          <Explorer />
          <DebugSide />
        </div>
        <Splitter />
        <Dock ref={dock} />
      </main>
      <Timeline />
      <StatusBar />
      <Instances />
      <BuildMessage />
      <OnlineChange />
      <Sweeping />
      <TraceImport />
      <VerifyRecords />
      <Past />
      <Palette />
      <Keys />
    </div>
  );
}

/** The tour is loaded when somebody takes it. */
function TourWhenOpen() {
  const open = useTour((tour) => tour.open);
  return open ? <Tour /> : null;
}

/** The page cannot show anything: why, and what to do about it. */
function Shut({ locked }: { locked: boolean }) {
  const problem = useBench((bench) => bench.problem);
  return (
    <main className="shut">
      <Icon name={locked ? "forced" : "lost"} />
      <h1>{t(locked ? "shut.locked" : "shut.failed")}</h1>
      <p>{t(locked ? "shut.locked.about" : "shut.failed.about")}</p>
      {locked ? <KeyForm /> : <p className="mono faint">{problem}</p>}
      {!locked && (
        <button type="button" className="btn" onClick={() => void start()}>
          {t("lost.now")}
        </button>
      )}
    </main>
  );
}

/** The current address with the token added: the server stores the token in a cookie and redirects back. */
function KeyForm() {
  const kept = [...new URLSearchParams(location.search)].filter(([name]) => name !== "token");
  return (
    <form method="get" action={location.pathname}>
      {kept.map(([name, value]) => (
        <input key={name} type="hidden" name={name} value={value} />
      ))}
      <label className="field">
        <span>{t("shut.locked.token")}</span>
        <input className="inp" type="password" name="token" autoComplete="current-password" required />
      </label>
      <button type="submit" className="btn primary">
        {t("shut.locked.open")}
      </button>
    </form>
  );
}
