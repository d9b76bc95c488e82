import { expect, type Locator, type Page } from '@playwright/test';
import { Debug } from './debug';
import { Diagnostics } from './diagnostics';
import { Editor } from './editor';
import { Explorer } from './explorer';
import { Forces } from './forces';
import { InstanceList } from './instances';
import { Past } from './past';
import { Problems } from './problems';
import { Simulator } from './simulator';
import { Sweeps } from './sweep';
import { toFront } from './tabs';
import { Timeline } from './timeline';
import { TopBar } from './topbar';
import { Watch } from './watch';

/** The whole window of one person. */
export class Ide {
  readonly top: TopBar;
  readonly explorer: Explorer;
  readonly watch: Watch;
  readonly forces: Forces;
  readonly simulator: Simulator;
  readonly sweeps: Sweeps;
  readonly problems: Problems;
  readonly diagnostics: Diagnostics;
  readonly timeline: Timeline;
  readonly past: Past;
  readonly instances: InstanceList;
  readonly debug: Debug;

  constructor(readonly page: Page) {
    this.top = new TopBar(page);
    this.explorer = new Explorer(page);
    this.watch = new Watch(page);
    this.forces = new Forces(page);
    this.simulator = new Simulator(page);
    this.sweeps = new Sweeps(page);
    this.problems = new Problems(page);
    this.diagnostics = new Diagnostics(page);
    this.timeline = new Timeline(page);
    this.past = new Past(page);
    this.instances = new InstanceList(page);
    this.debug = new Debug(page);
  }

  editor(file: string): Editor {
    return new Editor(this.page, file);
  }

  /** The banner below the top bar: what is wrong, and how to continue. */
  get banner(): Locator {
    return this.page
      .getByRole('alert')
      .filter({ has: this.page.getByRole('button') })
      .first();
  }

  get statusBar(): Locator {
    return this.page.getByRole('contentinfo');
  }

  /** Waits until the page is ready: the program runs, and its scans are counted. */
  async runs(): Promise<void> {
    await expect(this.top.state).toContainText('Running');
    await this.top.scansGoOn();
  }

  async showPanel(name: 'Watch' | 'Events' | 'Error simulator' | 'History'): Promise<void> {
    await toFront(this.page.getByRole('tab', { name, exact: true }));
  }

  /** The name of the pane with the focus; empty when none has it. */
  async focusedPane(): Promise<string> {
    return this.page.evaluate(() => document.activeElement?.closest<HTMLElement>('[data-pane]')?.dataset.pane ?? '');
  }

  /** F6 until a pane has the focus. */
  async goToPane(pane: string): Promise<void> {
    for (let turn = 0; turn < 20 && (await this.focusedPane()) !== pane; turn += 1)
      await this.page.keyboard.press('F6');
    expect(await this.focusedPane()).toBe(pane);
  }

  history(error: string): Locator {
    return this.page.getByRole('table', { name: 'Error history' }).getByRole('row').filter({ hasText: error });
  }
}
