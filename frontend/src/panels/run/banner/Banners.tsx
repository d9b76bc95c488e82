import { waitsForSpace } from "../../../logic/plc/plcstate";
import { usePlc } from "../../../store/plc/plc";
import { AloneBanner } from "./AloneBanner";
import { DeletedBanner } from "./DeletedBanner";
import { FatalBanner } from "./FatalBanner";
import { FollowBanner } from "./FollowBanner";
import { LinkBanner } from "./LinkBanner";
import { LostBanner } from "./LostBanner";
import { NameBanner } from "./NameBanner";
import { OffBanner } from "./OffBanner";
import { PastBanner } from "./PastBanner";
import { RecordingBanner } from "./RecordingBanner";
import { RerunBanners } from "./RerunBanner";
import { RestartingBanner } from "./RestartingBanner";
import { SpaceBanner } from "./SpaceBanner";
import { TakenBanner } from "./TakenBanner";
import { TrapBanner } from "./TrapBanner";

/** At most one banner about the PLC, the most severe: no connection, then a stop; and one about its recording. Below: the link that was
 * opened, whom one follows, forces that others replaced, one's name, and replays of the run. */
export function Banners() {
  const link = usePlc((plc) => plc.link);
  if (link.state === "lost") return <LostBanner link={link} />;
  return (
    <>
      <PlcBanner />
      <RecordingBanner />
      <AloneBanner />
      <LinkBanner />
      <FollowBanner />
      <TakenBanner />
      <NameBanner />
      <RerunBanners />
    </>
  );
}

function PlcBanner() {
  const state = usePlc((plc) => plc.state);
  const deletedBy = usePlc((plc) => plc.deletedBy);
  if (deletedBy !== null) return <DeletedBanner by={deletedBy} />;
  if (!state) return null;
  switch (state.state) {
    case "trapped":
      return <TrapBanner state={state} />;
    case "fatal":
      return <FatalBanner state={state} />;
    case "restarting":
    case "silent":
    case "failed":
      return <RestartingBanner state={state} />;
    case "past":
      return <PastBanner state={state} />;
    case "off":
      return <OffBanner />;
    case "no_space":
      // A PLC that has a process reports it as a problem of its recording.
      return waitsForSpace(state) ? <SpaceBanner state={state} /> : null;
    default:
      return null;
  }
}
