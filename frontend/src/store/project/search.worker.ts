/** Looks for a regular expression beside the page: some expressions take for ever on some texts, and would freeze it. */
import { matches, pattern } from "../../logic/project/search";
import type { FileMatches, Question } from "./searching";

self.onmessage = ({ data: { wanted, texts } }: MessageEvent<Question>) => {
  const expression = pattern(wanted);
  const found: FileMatches[] = [];
  for (const { path, text } of expression ? texts : []) {
    const inFile = matches(text, expression as RegExp);
    if (inFile.length > 0) found.push({ path, matches: inFile });
  }
  self.postMessage(found);
};
