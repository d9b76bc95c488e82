import type { Locator, Page } from '@playwright/test';
import { toFront } from './tabs';

interface Shown {
  squiggle: number;
  problem: number;
}

/** The list of the compiler's problems. */
export class Problems {
  constructor(private readonly page: Page) {}

  get tab(): Locator {
    return this.page.getByRole('tab', { name: /^Problems/ });
  }

  get list(): Locator {
    return this.page.getByRole('list', { name: 'Problems' });
  }

  get entries(): Locator {
    return this.list.getByRole('button');
  }

  async show(): Promise<void> {
    await toFront(this.tab);
  }

  /** Milliseconds from the next key to its squiggle and its entry in the list, measured inside the page. */
  async measureFromKeyToShown(): Promise<() => Promise<Shown>> {
    await this.page.evaluate(() => {
      const shown = new Promise<Shown>((done) => {
        let pressed: number | null = null;
        const found: Partial<Shown> = {};
        const look = (): void => {
          if (pressed === null) return;
          const now = performance.now() - pressed;
          if (found.squiggle === undefined && document.querySelector('.squiggly-error')) found.squiggle = now;
          if (found.problem === undefined && document.querySelector('[aria-label="Problems"] button'))
            found.problem = now;
          if (found.squiggle === undefined || found.problem === undefined) return;
          observer.disconnect();
          done(found as Shown);
        };
        const observer = new MutationObserver(look);
        observer.observe(document.body, { childList: true, subtree: true, attributes: true });
        const start = (): void => {
          pressed = performance.now();
        };
        addEventListener('keydown', start, { capture: true, once: true });
      });
      Object.assign(window, { shown });
    });
    return () => this.page.evaluate(() => (window as unknown as { shown: Promise<Shown> }).shown);
  }
}
