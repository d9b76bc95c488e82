import { expect, it } from "vitest";
import { asked, inlaysChanged, onInlaysChanged } from "./inlayChanges";

it("tells a change that came while Monaco waited for answers, and did not listen, once it listens again", async () => {
  let give: () => void = () => undefined;
  const answer = asked(new Promise<void>((done) => (give = done)));
  inlaysChanged();
  give();
  await answer;
  const told = new Promise<void>((done) => onInlaysChanged(() => done()));
  await expect(told).resolves.toBeUndefined();
});
